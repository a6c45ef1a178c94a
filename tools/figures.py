"""Measures the figures of docs/figures.md: python3 tools/figures.py PROGRAM docs/figures.md out/bench/data

The scans of ../shared are reconstructed in place; simulated scans are written to a temporary folder. Each figure
stands beside the command that reproduces it.
"""
import pathlib
import sys
import tempfile

import numpy

from figure_report import Report, ask
from figures_decimation import decimation

PROGRAM = pathlib.Path(sys.argv[1]).resolve()
REPORT = pathlib.Path(sys.argv[2])
BENCH_DATA = pathlib.Path(sys.argv[3] if len(sys.argv) > 3 else "out/bench/data")
SHARED = pathlib.Path(__file__).resolve().parent.parent.parent / "shared" / "scans"
WORK = pathlib.Path(tempfile.mkdtemp(prefix="frangia-figures-"))

report = Report()
add = report.add


def run(*arguments):
    return ask(PROGRAM, *arguments)


def read_ply(path):
    """The vertices of a PLY that the program wrote, as a structured array by property name."""
    raw = path.read_bytes()
    end = raw.index(b"end_header\n") + len(b"end_header\n")
    types = {"float": "<f4", "uchar": "u1", "ushort": "<u2", "int": "<i4", "uint": "<u4"}
    columns, counts, element = [], {}, None
    for line in raw[:end].decode().splitlines():
        words = line.split()
        if words[0] == "element":
            element = words[1]
            counts[element] = int(words[2])
        if words[0] == "property" and element == "vertex":
            columns.append((words[2], types[words[1]]))
    vertex_type = numpy.dtype(columns)
    vertices = numpy.frombuffer(raw, vertex_type, counts["vertex"], end)
    return vertices


def read_triangles(path):
    """The triangles of a PLY that the program wrote: faces come last, 13 bytes each, or 14 with a mark."""
    raw = path.read_bytes()
    head = raw[: raw.index(b"end_header\n")].decode()
    count = int(head.split("element face ")[1].split()[0])
    kind = [("n", "u1"), ("v", "<i4", 3)] + ([("mark", "u1")] if "mark" in head.split("element face ")[1] else [])
    return numpy.frombuffer(raw[-count * numpy.dtype(kind).itemsize :], numpy.dtype(kind), count)["v"]


def points_of(vertices):
    return numpy.stack([vertices[axis].astype(float) for axis in "xyz"], axis=1)


def fit_sphere(points, centre, radius):
    for _ in range(30):
        away = points - centre
        distance = numpy.linalg.norm(away, axis=1)
        jacobian = numpy.c_[-away / distance[:, None], -numpy.ones(len(points))]
        step = numpy.linalg.lstsq(jacobian, radius - distance, rcond=None)[0]
        centre, radius = centre + step[:3], radius + step[3]
    return centre, radius, numpy.sqrt(numpy.mean((distance - radius) ** 2))


def box(p, low, high):
    low, high = numpy.array(low, float), numpy.array(high, float)
    q = numpy.abs(p - (low + high) / 2) - (high - low) / 2
    return numpy.linalg.norm(numpy.maximum(q, 0), axis=1) + numpy.minimum(q.max(axis=1), 0)


def cylinder(p, x, y, radius, low, high):
    q = numpy.stack([numpy.hypot(p[:, 0] - x, p[:, 1] - y) - radius, numpy.abs(p[:, 2] - (low + high) / 2) - (high - low) / 2], axis=1)
    return numpy.linalg.norm(numpy.maximum(q, 0), axis=1) + numpy.minimum(q.max(axis=1), 0)


def block(p):
    body = numpy.maximum(box(p, [-35, -22, 0], [35, 22, 50]), -box(p, [8, -14, 36], [28, 14, 99]))
    return numpy.minimum(body, cylinder(p, -12, 0, 12, 50, 75))


def seconds(answer):
    return ", ".join(f"{stage} {time:.2f}" for stage, time in answer["seconds"].items())


def skull():
    add("## A real scan: the skull")
    if not (SHARED / "skull").exists():
        add("Skipped: the shared scans are not on this machine.\n")
        return
    mesh = WORK / "skull.ply"
    answer = run("reconstruct", SHARED / "skull", "-o", mesh)
    raw = (SHARED / "skull" / "reference.ply").read_bytes()
    reference = numpy.frombuffer(raw, "<f4", offset=raw.index(b"end_header\n") + 11).reshape(-1, 3)
    from scipy.spatial import cKDTree

    distance = cKDTree(reference).query(points_of(read_ply(mesh)))[0]
    add("`frangia reconstruct ../shared/scans/skull -o skull.ply`; distances to the nearest point of its `reference.ply`, which is itself coarse.\n")
    add("| | measured | wanted |\n|---|---|---|")
    add(f"| points | {answer['points']} | at least 300 000 |")
    add(f"| vertices, triangles | {answer['vertices']}, {answer['triangles']} | |")
    add(f"| median distance of a vertex, mm | {numpy.median(distance):.3f} | at most 0.40 |")
    add(f"\nSeconds: {seconds(answer)}; peak {answer['peak_memory_mb']:.0f} MB.\n")


def balls():
    add("## The ball bar")
    if not (SHARED / "balls").exists():
        add("Skipped: the shared scans are not on this machine.\n")
        return
    mesh = WORK / "balls.ply"
    answer = run("reconstruct", SHARED / "balls", "-o", mesh)
    points = points_of(read_ply(mesh))
    add("`frangia reconstruct ../shared/scans/balls -o balls.ply`; spheres fitted by least squares to the vertices above z = 47 mm and within 0.5 mm of the nominal sphere.\n")
    add("| | measured | wanted |\n|---|---|---|")
    centres = []
    for side in (-35.0, 35.0):
        from_centre = numpy.linalg.norm(points - [0.0, side, 60.0], axis=1)
        near = points[(points[:, 2] > 47) & (numpy.abs(from_centre - 20) < 0.5)]
        centre, radius, rms = fit_sphere(near, numpy.array([0.0, side, 60.0]), 20.0)
        centres.append(centre)
        add(f"| sphere at y = {side:.0f}: diameter, mm | {2 * radius:.4f} | 40 within 0.02 |")
        add(f"| residuals of its vertices, RMS mm | {rms:.4f} | at most 0.012 |")
    add(f"| spacing, mm | {numpy.linalg.norm(centres[0] - centres[1]):.4f} | 70 within 0.02 |")
    add(f"\nSeconds: {seconds(answer)}; peak {answer['peak_memory_mb']:.0f} MB.\n")


def paper_block():
    add("## The paper's rig: the block, with fringe orders from the laser sheet alone")
    if not (SHARED / "block").exists():
        add("Skipped: the shared scans are not on this machine.\n")
        return
    mesh = WORK / "block.ply"
    answer = run("reconstruct", SHARED / "block", "-o", mesh)
    vertices = read_ply(mesh)
    distance = block(points_of(vertices))
    add("`frangia reconstruct ../shared/scans/block -o block.ply`; distances of the vertices to the analytic block. One fringe order corresponds to 28 mm of depth.\n")
    add("| | measured | wanted |\n|---|---|---|")
    add(f"| RMS, mm | {numpy.sqrt(numpy.mean(distance**2)):.4f} | at most 0.08 |")
    add(f"| 99 %, mm | {numpy.percentile(numpy.abs(distance), 99):.4f} | |")
    add(f"| maximum, mm | {numpy.abs(distance).max():.4f} | less than one fringe |")
    add(f"| RMS of error over its predicted sigma | {numpy.sqrt(numpy.mean((distance / vertices['sigma_mm']) ** 2)):.2f} | 1 |")
    add(f"\nSeconds for 8 views of 512 x 512: {seconds(answer)}; peak {answer['peak_memory_mb']:.0f} MB.\n")


def simulated():
    add("## Simulated scans against their truth")
    add("`frangia simulate PART --rig RIG --samples 4 -o SCAN`, `frangia reconstruct SCAN -o MESH.ply`, `frangia inspect MESH.ply --reference SCAN/truth.ply --scan SCAN`. Completeness: share of the measurable surface (seen by camera and projector of one view within 75 or 60 degrees of the normal) that has mesh within 0.2 mm. Error over sigma: RMS of each vertex's error divided by its predicted sigma, wanted 0.8 to 1.25. Defects: non-manifold edges and inward-facing triangles, wanted none. The carducci rig is that of the paper: f 12.5 mm, 20 degrees, camera at 490 mm, projector at 1000 mm, 1 fringe per degree, 512 x 512, 8 views.\n")
    add("| part | rig | points | RMS mm | 99 % mm | maximum mm | completeness, 75 | completeness, 60 | error over sigma | defects |\n|---|---|---|---|---|---|---|---|---|---|")
    for part, rig in [
        ("bust", "carducci"),
        ("bust", "digital"),
        ("blade", "digital"),
        ("bracket", "digital"),
        ("shaft", "digital"),
        ("ball-bar", "digital"),
        ("bust", "angular"),
        ("blade", "angular"),
        ("bracket", "angular"),
        ("shaft", "angular"),
    ]:
        scan, mesh = WORK / f"{part}-{rig}", WORK / f"{part}-{rig}.ply"
        run("simulate", part, "--rig", rig, "--samples", 4, "-o", scan)
        answer = run("reconstruct", scan, "-o", mesh)
        error = run("inspect", mesh, "--reference", scan / "truth.ply", "--scan", scan)
        squarely = run("inspect", mesh, "--reference", scan / "truth.ply", "--scan", scan, "--max-angle", 60)
        add(f"| {part} | {rig} | {answer['points']} | {error['rms_mm']:.4f} | {error['p99_mm']:.4f} | {error['max_mm']:.3f} | {100 * error['completeness']:.1f} % | {100 * squarely['completeness']:.1f} % | {error['sigma_ratio']:.2f} | {error['non_manifold_edges']}, {error['inward_triangles']} |")
    add()


def write_box(path, half, height):
    corners = numpy.array([[x, y, z] for z in (0.0, height) for y in (-half[1], half[1]) for x in (-half[0], half[0])])
    quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (1, 3, 7, 5), (3, 2, 6, 7), (2, 0, 4, 6)]
    faces = [(a, b, c) for a, b, c, _ in quads] + [(a, c, d) for a, _, c, d in quads]
    text = f"ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\nelement face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n"
    text += "".join("{} {} {}\n".format(*corner) for corner in corners) + "".join("3 {} {} {}\n".format(*face) for face in faces)
    path.write_text(text)


def distance_to_triangles(points, a, b, c):
    """The distance of each point to its own triangle."""
    def to_segment(p, q):
        along = q - p
        t = numpy.clip(((points - p) * along).sum(1) / numpy.maximum((along**2).sum(1), 1e-12), 0, 1)
        return numpy.linalg.norm(points - p - t[:, None] * along, axis=1)

    normal = numpy.cross(b - a, c - a)
    normal /= numpy.maximum(numpy.linalg.norm(normal, axis=1), 1e-12)[:, None]
    off = ((points - a) * normal).sum(1)
    foot = points - off[:, None] * normal
    inside = numpy.ones(len(points), bool)
    for p, q in ((a, b), (b, c), (c, a)):
        inside &= (numpy.cross(q - p, foot - p) * normal).sum(1) >= 0
    return numpy.where(inside, numpy.abs(off), numpy.minimum(numpy.minimum(to_segment(a, b), to_segment(b, c)), to_segment(c, a)))


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


def block_edges():
    from scipy.spatial import cKDTree

    half, height = numpy.array([25.0, 18.0]), 30.0
    part, scan, mesh = WORK / "block.ply", WORK / "block", WORK / "block-mesh.ply"
    write_box(part, half, height)
    run("simulate", part, "--rig", "digital", "--samples", 4, "-o", scan)
    run("reconstruct", scan, "--voxel", 0.3, "-o", mesh)
    vertices = points_of(read_ply(mesh))
    triangles = read_triangles(mesh)
    low, high = numpy.array([*-half, 0.0]), numpy.array([*half, height])
    edges = sharp_edges(half, height)
    corners = [vertices[triangles[:, i]] for i in range(3)]
    near = cKDTree(sum(corners) / 3).query(edges, k=24)[1]
    distance = numpy.min([distance_to_triangles(edges, *(corner[near[:, k]] for corner in corners)) for k in range(near.shape[1])], axis=0)
    inner = numpy.sort(numpy.abs(numpy.stack([vertices - low, vertices - high], axis=2)).min(axis=2), axis=1)
    flat = vertices[(inner[:, 1] > 1.0) & (vertices[:, 2] > 2.0)]
    off = box(flat, low, high)
    add("## A block with sharp edges")
    add("A box of 50 x 36 x 30 mm, digital rig, 8 views: `frangia reconstruct block --voxel 0.3 -o block.ply`. Measured on its 4 vertical and 4 upper edges, which the views see, and on the faces at more than 1 mm from every edge.\n")
    add("| | measured | wanted |\n|---|---|---|")
    add(f"| share of the edge length with mesh within 0.06 mm | {100 * numpy.mean(distance < 0.06):.2f} % | 99 % |")
    add(f"| 99 % of the edge length has mesh within, mm | {numpy.percentile(distance, 99):.3f} | 0.06 |")
    add(f"| flat faces, RMS mm | {numpy.sqrt(numpy.mean(off**2)):.4f} | at most 0.01 |\n")


def misaligned_turntable():
    add("## A misaligned turntable")
    add("The axis 0.5 mm and 0.3 degrees from the one in rig.toml, the angles with errors of 0.15 degrees RMS (`--axis-offset 0.5 --axis-tilt 0.3 --angle-error 0.15`), digital rig, 8 views; wanted: at most 15 % worse than with the exact rig.\n")
    add("| part | exact rig, RMS mm | misaligned, registered | ratio of the two | misaligned, not registered |\n|---|---|---|---|---|")
    for part in ("bust", "bracket", "shaft"):
        exact = WORK / f"{part}-digital"
        misaligned, mesh = WORK / f"{part}-misaligned", WORK / f"{part}-misaligned.ply"
        run("simulate", part, "--rig", "digital", "--samples", 4, "--axis-offset", 0.5, "--axis-tilt", 0.3, "--angle-error", 0.15, "-o", misaligned)
        rms = []
        for scan, options in ((exact, ["--no-register"]), (misaligned, []), (misaligned, ["--no-register"])):
            run("reconstruct", scan, "-o", mesh, *options)
            rms.append(run("inspect", mesh, "--reference", scan / "truth.ply")["rms_mm"])
        add(f"| {part} | {rms[0]:.4f} | {rms[1]:.4f} | {100 * rms[1] / rms[0]:.0f} % | {rms[2]:.4f} |")
    add()


RIG_5MPX = """format = "frangia-rig"
version = 1
[camera]
size_px = [2560, 2048]
focal_px = [4800.0, 4800.0]
principal_point_px = [1308.7, 1007.1]
distortion = [-0.09, 0.05, 4e-4, -3e-4, 0.0]
white_level = 255
[projector]
model = "pinhole"
position_mm = [-180.0, -20.0, 30.0]
rotation = [[0.931242779706, 0, -0.364399348581], [-0.0147420196862, 0.999181334288, -0.0376740503092], [0.364101027328, 0.0404556697031, 0.930480403172]]
size_px = [1280, 800]
focal_px = [1900.0, 1900.0]
principal_point_px = [639.5, 399.5]
[turntable]
point_mm = [3.5, 50.0, 516.0]
axis = [-0.0094, -0.8829, -0.4694]
"""


def large():
    add("## Twenty views of 5 Mpx with 12 frames each")
    rig, scan, mesh = WORK / "rig.toml", WORK / "large", WORK / "large.ply"
    rig.write_text(RIG_5MPX)
    run("simulate", "bust", "--rig", rig, "--views", 20, "-o", scan)
    answer = run("reconstruct", scan, "-o", mesh)
    add("The bust, a digital projector, three periods of four frames: `frangia reconstruct large -o large.ply`.\n")
    add("| stage | s |\n|---|---|")
    for stage, time in answer["seconds"].items():
        add(f"| {stage} | {time:.2f} |")
    add(f"\n{answer['points']} points, {answer['triangles']} triangles, peak {answer['peak_memory_mb']:.0f} MB (wanted 3000).\n")


def vertex_normals(points, triangles):
    corners = [points[triangles[:, i]] for i in range(3)]
    cross = numpy.cross(corners[1] - corners[0], corners[2] - corners[0])
    sums = numpy.zeros_like(points)
    for i in range(3):
        numpy.add.at(sums, triangles[:, i], cross)
    return sums / numpy.maximum(numpy.linalg.norm(sums, axis=1), 1e-12)[:, None]


def write_noisy(path, points, triangles, sigma_mm):
    """Writes a binary PLY of positions and sigma."""
    vertices = numpy.zeros(len(points), [("x", "<f4"), ("y", "<f4"), ("z", "<f4"), ("sigma", "<f4")])
    for i, axis in enumerate("xyz"):
        vertices[axis] = points[:, i]
    vertices["sigma"] = sigma_mm
    faces = numpy.zeros(len(triangles), [("n", "u1"), ("v", "<i4", 3)])
    faces["n"], faces["v"] = 3, triangles
    head = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\nproperty float x\nproperty float y\nproperty float z\nproperty float sigma_mm\nelement face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n"
    path.write_bytes(head.encode() + vertices.tobytes() + faces.tobytes())


def from_edges(points, edges):
    from scipy.spatial import cKDTree

    return cKDTree(edges).query(points)[0]


def edits():
    add("## Edits")
    add("Results of `frangia edit` on simulated scans, digital rig, 8 views. The bust is scanned without noise; then independent noise of 0.02 mm RMS displaces every vertex along its normal, and the remaining displacement along that normal is measured. The last rows compare a scan with a twelfth of the light (`--exposure 0.08`) with the true surface: part of its noise has wavelengths longer than an edge, so smoothing that removes it also removes shape. The rows without noise state how much shape. The block is the one with sharp edges above.\n")
    add("| | measured | wanted |\n|---|---|---|")
    bar, mesh, filled = WORK / "edit-bar", WORK / "edit-bar.ply", WORK / "edit-filled.ply"
    run("simulate", "ball-bar", "--rig", "digital", "--samples", 4, "-o", bar)
    run("reconstruct", bar, "-o", mesh)
    points = points_of(read_ply(mesh))
    for side in (-35.0, 35.0):
        from_centre = numpy.linalg.norm(points - [0.0, side, 60.0], axis=1)
        near = points[(points[:, 2] > 47) & (numpy.abs(from_centre - 20) < 0.5)]
        centre, radius, _ = fit_sphere(near, numpy.array([0.0, side, 60.0]), 20.0)
        top = centre + radius * numpy.array([0.0, numpy.sign(side) * 0.6, 0.8])
        run("edit", mesh, "--remove-islands", "5mm", "--select-ball", ",".join(f"{x:.4f}" for x in top) + ",10", "--delete", "--fill-holes", "25mm", "-o", filled)
        vertices = read_ply(filled)
        patch = points_of(vertices[vertices["mark"] == 2])
        patch = patch[numpy.linalg.norm(patch - top, axis=1) < 11]
        off = numpy.abs(numpy.linalg.norm(patch - centre, axis=1) - radius)
        add(f"| a filled hole of 20 mm in a sphere of 40 mm: maximum distance of {len(patch)} vertices from the sphere, mm | {off.max():.3f} | at most 0.15 |")
    scan, mesh, noisy, smooth = WORK / "edit-head", WORK / "edit-head.ply", WORK / "edit-noisy.ply", WORK / "edit-smooth.ply"
    run("simulate", "bust", "--rig", "digital", "--samples", 4, "--no-noise", "-o", scan)
    run("reconstruct", scan, "-o", mesh)
    points, triangles = points_of(read_ply(mesh)), read_triangles(mesh)
    normals = vertex_normals(points, triangles)
    spread = 0.02 * numpy.random.default_rng(1).standard_normal(len(points))
    write_noisy(noisy, points + spread[:, None] * normals, triangles, 0.02)
    for steps in (["--smooth", 10], ["--smooth-keeping-edges", 4]):
        run("edit", noisy, *steps, "-o", smooth)
        left = ((points_of(read_ply(smooth)) - points) * normals).sum(axis=1)
        add(f"| noise of the bust after `{' '.join(map(str, steps))}`, relative to before | {numpy.sqrt(numpy.mean(left**2)) / numpy.sqrt(numpy.mean(spread**2)):.2f} | at most 0.5 |")
    half, height = numpy.array([25.0, 18.0]), 30.0
    edges = sharp_edges(half, height)
    block = WORK / "block-mesh.ply"
    before = points_of(read_ply(block))
    on_edge = from_edges(before, edges) < 0.06
    for steps in (["--smooth", 10], ["--smooth-keeping-edges", 4]):
        run("edit", block, *steps, "-o", smooth)
        after = points_of(read_ply(smooth))
        moved = numpy.linalg.norm(after[on_edge] - before[on_edge], axis=1)
        add(f"| maximum displacement by `{' '.join(map(str, steps))}` of {on_edge.sum()} vertices on the edges of the block, mm | {moved.max():.3f} | at most 0.03 |")
    dim = WORK / "edit-dim"
    run("simulate", "bust", "--rig", "digital", "--samples", 4, "--exposure", 0.08, "-o", dim)
    clean = WORK / "edit-clean.ply"
    run("edit", WORK / "edit-head.ply", "-o", clean)
    run("reconstruct", dim, "-o", mesh)
    for steps in ([], ["--smooth", 10], ["--smooth", 25], ["--smooth-keeping-edges", 4], ["--smooth-keeping-edges", 6]):
        after = f" after `{' '.join(map(str, steps))}`" if steps else ""
        run("edit", mesh, *steps, "-o", smooth)
        error = run("inspect", smooth, "--reference", dim / "truth.ply")
        run("edit", clean, "--max-sigmas", 0, *steps, "-o", smooth)
        lost = run("inspect", smooth, "--reference", scan / "truth.ply")
        add(f"| the bust with little light{after}: error, RMS mm | {error['rms_mm']:.4f} | |")
        add(f"| the bust without noise{after}, with unlimited displacement: error, RMS mm | {lost['rms_mm']:.4f} | |")
    add()


add("# Figures\n\nMeasured by `./run figures`, which writes this file; not edited by hand. Times are from a machine with two cores.\n")
skull()
balls()
paper_block()
simulated()
block_edges()
misaligned_turntable()
large()
edits()
decimation(add, BENCH_DATA)
report.write(REPORT)
