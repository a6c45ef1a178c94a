"""How much of the length of sharp edges the mesh keeps."""
import numpy
from scipy.spatial import cKDTree

import sharp_block
from surfaces import box, distance_to_triangles, points_of, read_ply, read_triangles, rms

TITLE = "A block with sharp edges"


def measure(study, case, seed):
    half, height = sharp_block.HALF, sharp_block.HEIGHT
    mesh = sharp_block.fused_block(study)
    vertices, triangles = points_of(read_ply(mesh)), read_triangles(mesh)
    low, high = numpy.array([*-half, 0.0]), numpy.array([*half, height])
    edges = sharp_block.sharp_edges(half, height)
    corners = [vertices[triangles[:, i]] for i in range(3)]
    near = cKDTree(sum(corners) / 3).query(edges, k=24)[1]
    distance = numpy.min(
        [distance_to_triangles(edges, *(corner[near[:, k]] for corner in corners)) for k in range(near.shape[1])],
        axis=0,
    )
    inner = numpy.sort(numpy.abs(numpy.stack([vertices - low, vertices - high], axis=2)).min(axis=2), axis=1)
    flat = vertices[(inner[:, 1] > 1.0) & (vertices[:, 2] > 2.0)]
    return {
        "kept": numpy.mean(distance < 0.06),
        "p99_mm": numpy.percentile(distance, 99),
        "flat_mm": rms(box(flat, low, high)),
    }


def report(text, results):
    result = results["sharp_edges"][0]
    text.add(
        "A box of 50 x 36 x 30 mm, digital rig, 8 views: `frangia reconstruct block --voxel 0.3 -o block.ply`. Measured on its 4 vertical and 4 upper edges, which the views see, and on the faces at more than 1 mm from every edge.\n"
    )
    text.table("", "measured", "wanted")
    text.row("share of the edge length with mesh within 0.06 mm", f"{100 * result['kept']:.2f} %", "99 %")
    text.row("99 % of the edge length has mesh within, mm", f"{result['p99_mm']:.3f}", "0.06")
    text.row("flat faces, RMS mm", f"{result['flat_mm']:.4f}", "at most 0.01")
