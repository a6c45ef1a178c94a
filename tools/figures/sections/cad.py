"""Deviations from the exact faces of a STEP part, against analytic distances, and their time."""
import subprocess

import numpy

from study import NotMeasured
from surfaces import points_of, read_ply

TITLE = "Deviations from a CAD model"
PAGE = "inspection.md"
SPACING = 100.0  # of the parts, mm
PARTS = ["box (planes)", "cylinder", "sphere", "torus", "sphere of B-splines", "torus of B-splines"]


def grid_mesh(points):
    """The triangles of a grid of points, open at its ends."""
    rows, columns = points.shape[:2]
    i, k = numpy.arange(rows - 1)[:, None], numpy.arange(columns - 1)[None, :]
    a = (i * columns + k).ravel()
    b = a + columns
    return points.reshape(-1, 3), numpy.concatenate([numpy.stack([a, a + 1, b], 1), numpy.stack([b, a + 1, b + 1], 1)])


def surface(part, side):
    """A grid of points on one part, its triangles outward."""
    u, v = numpy.meshgrid(
        numpy.linspace(0, 2 * numpy.pi, side), numpy.linspace(0.05, numpy.pi - 0.05, side), indexing="ij"
    )
    ball = numpy.stack([numpy.sin(v) * numpy.cos(u), numpy.sin(v) * numpy.sin(u), numpy.cos(v)], -1)
    if part == 0:
        return 15 * ball / abs(ball).max(-1, keepdims=True)
    if part == 1:
        return ball * numpy.minimum(
            20 / numpy.hypot(ball[..., :1], ball[..., 1:2]), 20 / numpy.maximum(abs(ball[..., 2:]), 1e-9)
        )
    if part in (2, 4):
        return 20 * ball
    w = 2 * v - numpy.pi
    ring = 20 + 6 * numpy.cos(w)
    return numpy.stack([ring * numpy.cos(u), ring * numpy.sin(u), -6 * numpy.sin(w)], -1)


def distance(part, p):
    """The signed distance of points from one part."""
    across = numpy.hypot(p[:, 0], p[:, 1])
    if part in (2, 4):
        return numpy.linalg.norm(p, axis=1) - 20
    if part in (3, 5):
        return numpy.hypot(across - 20, p[:, 2]) - 6
    beyond = abs(p) - 15 if part == 0 else numpy.stack([across - 20, abs(p[:, 2]) - 20], 1)
    return numpy.linalg.norm(numpy.maximum(beyond, 0), axis=1) + numpy.minimum(beyond.max(1), 0)


def write_mesh(path, side):
    wave = numpy.linspace(0, 10 * numpy.pi, side)
    wave = 1 + 0.01 * numpy.outer(numpy.sin(wave), numpy.cos(wave))[..., None]
    points, triangles, count = [], [], 0
    for part in range(len(PARTS)):
        one, faces = grid_mesh(surface(part, side) * wave)
        points.append(one + [SPACING * part, 0, 0])
        triangles.append(faces + count)
        count += len(one)
    points, triangles = numpy.concatenate(points), numpy.concatenate(triangles)
    faces = numpy.empty(len(triangles), [("n", "u1"), ("v", "<i4", 3)])
    faces["n"], faces["v"] = 3, triangles
    head = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\n"
    head += "".join(f"property float {axis}\n" for axis in "xyz")
    head += f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n"
    path.write_bytes(head.encode() + points.astype("<f4").tobytes() + faces.tobytes())


def measure(study, case, seed):
    maker = study.tests / "make_cad_parts"
    if not maker.exists():
        raise NotMeasured("the program was built without OpenCASCADE or its tests")
    subprocess.run([maker, study.work], check=True, stdout=subprocess.DEVNULL)
    mesh, out = study.work / "cad-mesh.ply", study.work / "cad-out.ply"
    write_mesh(mesh, 578)
    answer = study.run("inspect", mesh, "--reference", study.work / "primitives.step", "-o", out)
    vertices = read_ply(out)
    points, deviation = points_of(vertices).astype(float), vertices["deviation_mm"].astype(float)
    rows = []
    for part, name in enumerate(PARTS):
        own = numpy.isfinite(deviation) & (numpy.rint(points[:, 0] / SPACING) == part)
        error = abs(deviation[own] - distance(part, points[own] - [SPACING * part, 0, 0]))
        rows.append([name, int(own.sum()), float(error.max())])
    return {"vertices": len(points), "seconds": answer["seconds"]["deviation"], "rows": rows}


def report(text, results):
    result = results["cad"][0]
    text.add(
        f"`frangia inspect MESH --reference primitives.step -o OUT.ply`: {result['vertices']} vertices within 1 % of the size of six parts, against the exact faces of the STEP file. "
        f"Their deviations take {result['seconds']:.1f} s on two cores (wanted 60).\n"
    )
    text.table("part", "compared vertices", "largest error, mm", "wanted, mm")
    for name, compared, error in result["rows"]:
        text.row(name, compared, f"{error:.1e}", "1e-4")
