"""A box with sharp edges: its mesh as a part, and points along its edges."""
import numpy
from scipy.spatial import cKDTree

HALF, HEIGHT = numpy.array([25.0, 18.0]), 30.0


def write_box(path, half, height):
    corners = numpy.array([[x, y, z] for z in (0.0, height) for y in (-half[1], half[1]) for x in (-half[0], half[0])])
    quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (1, 3, 7, 5), (3, 2, 6, 7), (2, 0, 4, 6)]
    faces = [(a, b, c) for a, b, c, _ in quads] + [(a, c, d) for a, _, c, d in quads]
    text = f"ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\nelement face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n"
    text += "".join("{} {} {}\n".format(*corner) for corner in corners) + "".join(
        "3 {} {} {}\n".format(*face) for face in faces
    )
    path.write_text(text)


def sharp_edges(half, height):
    """Points along the 4 upright and 4 upper edges of a box."""
    edges = []
    for t in numpy.arange(0.0, 1.0, 0.002):
        for x, y in ((-1, -1), (1, -1), (-1, 1), (1, 1)):
            edges.append([x * half[0], y * half[1], 2.0 + t * (height - 2.0)])
        for side in (-1, 1):
            edges.append([(2 * t - 1) * half[0], side * half[1], height])
            edges.append([side * half[0], (2 * t - 1) * half[1], height])
    return numpy.array(edges)


def distance_to_edges(points):
    return cKDTree(sharp_edges(HALF, HEIGHT)).query(points)[0]


def fused_block(study):
    """The scan of the block as a mesh."""
    part = study.work / "sharp-block.ply"
    write_box(part, HALF, HEIGHT)
    return study.reconstructed(study.digital(part), "--voxel", 0.3)[0]
