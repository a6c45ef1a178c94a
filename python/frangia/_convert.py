"""Meshes from and to other packages, each imported when it is used."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy

from ._arguments import need, need_members
from ._frangia import InputError, Mesh

if TYPE_CHECKING:
    import meshio
    import open3d
    import trimesh


def to_trimesh(mesh: Mesh) -> trimesh.Trimesh:
    """A trimesh.Trimesh with the uncertainty of each vertex as `vertex_attributes["sigma_mm"]`."""
    need("frangia.to_trimesh", "mesh", mesh, "Mesh")
    import trimesh

    colors = mesh.colors if len(mesh.colors) else None
    out = trimesh.Trimesh(mesh.vertices, mesh.triangles, vertex_colors=colors, process=False)
    if len(mesh.sigma_mm):
        out.vertex_attributes["sigma_mm"] = numpy.array(mesh.sigma_mm)
    return out


def from_trimesh(mesh: trimesh.Trimesh) -> Mesh:
    """A Mesh with the vertices and faces of a trimesh.Trimesh, in millimetres."""
    need_members("frangia.from_trimesh", "mesh", mesh, "trimesh.Trimesh", "vertices", "faces")
    return Mesh(mesh.vertices, mesh.faces)


def to_open3d(mesh: Mesh) -> open3d.geometry.TriangleMesh:
    """An open3d.geometry.TriangleMesh."""
    need("frangia.to_open3d", "mesh", mesh, "Mesh")
    import open3d

    out = open3d.geometry.TriangleMesh(
        open3d.utility.Vector3dVector(numpy.asarray(mesh.vertices, float)),
        open3d.utility.Vector3iVector(numpy.asarray(mesh.triangles, numpy.int32)),
    )
    if len(mesh.normals):
        out.vertex_normals = open3d.utility.Vector3dVector(numpy.asarray(mesh.normals, float))
    if len(mesh.colors):
        out.vertex_colors = open3d.utility.Vector3dVector(numpy.asarray(mesh.colors, float) / 255)
    return out


def to_meshio(mesh: Mesh) -> meshio.Mesh:
    """A meshio.Mesh with sigma_mm and views as point data."""
    need("frangia.to_meshio", "mesh", mesh, "Mesh")
    import meshio

    data: dict[str, Any] = {}
    for name in ("sigma_mm", "views"):
        values = getattr(mesh, name)
        if len(values):
            data[name] = numpy.array(values)
    return meshio.Mesh(mesh.vertices, [("triangle", mesh.triangles)], point_data=data)


def from_open3d(mesh: open3d.geometry.TriangleMesh) -> Mesh:
    """A Mesh with the vertices and triangles of an open3d.geometry.TriangleMesh, in millimetres."""
    need_members("frangia.from_open3d", "mesh", mesh, "open3d.geometry.TriangleMesh", "vertices", "triangles")
    return Mesh(numpy.asarray(mesh.vertices), numpy.asarray(mesh.triangles))


def from_meshio(mesh: meshio.Mesh) -> Mesh:
    """A Mesh with the points and the triangles of a meshio.Mesh, in millimetres."""
    need_members("frangia.from_meshio", "mesh", mesh, "meshio.Mesh", "points", "cells")
    triangles = [block.data for block in mesh.cells if block.type == "triangle"]
    if not triangles:
        kinds = ", ".join(sorted({block.type for block in mesh.cells})) or "none"
        raise InputError(f"the mesh of meshio has no cells of the type triangle; its cells are: {kinds}")
    return Mesh(mesh.points, numpy.concatenate(triangles))
