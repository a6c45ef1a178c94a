"""Meshes from and to other packages, each imported when it is used."""

import numpy

from ._frangia import Mesh


def to_trimesh(mesh):
    """A trimesh.Trimesh with the uncertainty of each vertex as `vertex_attributes["sigma_mm"]`."""
    import trimesh

    colors = mesh.colors if len(mesh.colors) else None
    out = trimesh.Trimesh(mesh.vertices, mesh.triangles, vertex_colors=colors, process=False)
    if len(mesh.sigma_mm):
        out.vertex_attributes["sigma_mm"] = numpy.array(mesh.sigma_mm)
    return out


def from_trimesh(mesh):
    """A Mesh with the vertices and faces of a trimesh.Trimesh, in millimetres."""
    return Mesh(mesh.vertices, mesh.faces)


def to_open3d(mesh):
    """An open3d.geometry.TriangleMesh."""
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


def to_meshio(mesh):
    """A meshio.Mesh with sigma_mm and views as point data."""
    import meshio

    data = {}
    for name in ("sigma_mm", "views"):
        values = getattr(mesh, name)
        if len(values):
            data[name] = numpy.array(values)
    return meshio.Mesh(mesh.vertices, [("triangle", mesh.triangles)], point_data=data)
