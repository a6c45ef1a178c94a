"""Best fits of simulated parts from random starts, beside CloudCompare's ICP, and of parts with symmetries."""
import shutil
import subprocess

import numpy

from surfaces import points_of, read_ply, read_triangles

TITLE = "Best fit from random starts"
PAGE = "inspection.md"

STARTS = 40
PARTS = ["bust", "blade", "bracket", "shaft"]
SYMMETRIC = ["ball-bar", "plain shaft"]
CASES = {case: 1 for case in PARTS + SYMMETRIC}


def random_pose(generator):
    """Any rotation, 500 mm away."""
    rotation, upper = numpy.linalg.qr(generator.normal(size=(3, 3)))
    rotation = rotation * numpy.sign(numpy.diag(upper))
    if numpy.linalg.det(rotation) < 0:
        rotation[:, 0] = -rotation[:, 0]
    way = generator.normal(size=3)
    return rotation, 500 * way / numpy.linalg.norm(way)


def write_moved(path, vertices, triangles, rotation, shift):
    """The mesh in another pose, with its sigma."""
    moved = vertices.copy()
    points = points_of(vertices) @ rotation.T + shift
    for i, axis in enumerate("xyz"):
        moved[axis] = points[:, i]
    types = {"f4": "float", "u1": "uchar", "u2": "ushort", "i4": "int", "u4": "uint"}
    lines = ["ply", "format binary_little_endian 1.0", f"element vertex {len(moved)}"]
    lines += [
        f"property {types[moved.dtype[name].str[1:]]} {name}"
        for name in moved.dtype.names
        if name not in ("nx", "ny", "nz")
    ]
    lines += [f"element face {len(triangles)}", "property list uchar int vertex_indices", "end_header", ""]
    kept = [name for name in moved.dtype.names if name not in ("nx", "ny", "nz")]
    packed = numpy.empty(len(moved), [(name, moved.dtype[name]) for name in kept])
    for name in kept:
        packed[name] = moved[name]
    faces = numpy.empty(len(triangles), [("n", "u1"), ("v", "<i4", 3)])
    faces["n"], faces["v"] = 3, triangles
    path.write_bytes("\n".join(lines).encode() + packed.tobytes() + faces.tobytes())


def difference(matrix, other, center):
    """Distance at the center, mm, and angle, degrees, between two poses."""
    a, b = numpy.array(matrix), numpy.array(other)
    turn = a[:3, :3] @ b[:3, :3].T
    angle = numpy.degrees(
        numpy.linalg.norm([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]]) / 2
    )
    return numpy.linalg.norm((a - b) @ numpy.append(center, 1.0)), angle


def cloud_compare(study, mesh, reference):
    """The pose of CloudCompare's ICP from the true start, with all of its points; None without the program."""
    if not (shutil.which("CloudCompare") and shutil.which("xvfb-run")):
        return None
    for old in mesh.parent.glob(f"{mesh.stem}_REGISTRATION_MATRIX*.txt"):
        old.unlink()
    subprocess.run(
        [
            "xvfb-run",
            "-a",
            "CloudCompare",
            "-SILENT",
            "-AUTO_SAVE",
            "OFF",
            "-O",
            mesh,
            "-O",
            reference,
            "-ICP",
            "-MIN_ERROR_DIFF",
            "1e-9",
            "-RANDOM_SAMPLING_LIMIT",
            "1000000",
        ],
        check=True,
        stdout=subprocess.DEVNULL,
    )
    (written,) = mesh.parent.glob(f"{mesh.stem}_REGISTRATION_MATRIX*.txt")
    return numpy.loadtxt(written)


def write_plain_shaft(path, facets=512):
    """A turned part without a keyway, as STL."""
    profile = numpy.array(
        [(0, 0), (18, 0), (18, 20), (26, 20), (26, 38), (18, 38), (18, 80), (14, 80), (14, 100), (0, 100)], float
    )
    angle = 2 * numpy.pi * numpy.arange(facets) / facets
    height = numpy.broadcast_to(profile[:, 1, None], (len(profile), facets))
    points = numpy.stack([profile[:, :1] * numpy.cos(angle), profile[:, :1] * numpy.sin(angle), height], -1)
    below, above = points[:-1], points[1:]
    next_below, next_above = numpy.roll(below, -1, axis=1), numpy.roll(above, -1, axis=1)
    triangles = numpy.concatenate(
        [numpy.stack([below, next_below, next_above], -2), numpy.stack([below, next_above, above], -2)]
    ).reshape(-1, 3, 3)
    area = numpy.linalg.norm(numpy.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]), axis=1)
    records = numpy.zeros((area > 0).sum(), [("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    records["corners"] = triangles[area > 0]
    path.write_bytes(bytes(80) + numpy.uint32(len(records)).tobytes() + records.tobytes())


def symmetric(study, part):
    """What the program says of a part that fits in more than one place."""
    shape = part
    if part == "plain shaft":
        shape = study.work / "plain-shaft.stl"
        write_plain_shaft(shape)
    scan = study.simulated(shape)
    mesh, _ = study.reconstructed(scan)
    said = study.process(
        "--quiet", "inspect", mesh, "--reference", scan / "truth.ply", "--align", "best-fit", allowed=None
    )
    lines = (said.stderr + said.stdout).splitlines()
    told = [line for line in lines if "fits the reference alike" in line or "not determined by the shape" in line]
    return f"exit code {said.returncode}: " + " ".join(told).removeprefix("frangia: ")


def measure(study, case, seed):
    if case in SYMMETRIC:
        return symmetric(study, case)
    scan = study.digital(case)
    mesh, moved = study.reconstructed(scan)[0], study.work / "moved.ply"
    vertices, triangles = read_ply(mesh), read_triangles(mesh)
    center = points_of(vertices).mean(axis=0)
    plain = study.run("inspect", mesh, "--reference", scan / "truth.ply", "--align", "best-fit")["alignment"]
    generator, off = numpy.random.default_rng(1), []
    for _ in range(STARTS):
        rotation, shift = random_pose(generator)
        write_moved(moved, vertices, triangles, rotation, shift)
        found = study.run("inspect", moved, "--reference", scan / "truth.ply", "--align", "best-fit")["alignment"]
        motion = numpy.eye(4)
        motion[:3, :3], motion[:3, 3] = rotation, shift
        off.append(difference(numpy.array(found["matrix"]) @ motion, plain["matrix"], center))
    other = cloud_compare(study, mesh, scan / "truth.ply")
    return {
        "off": off,
        "overlap": plain["overlap"],
        "rms_mm": plain["rms_mm"],
        "frame": difference(plain["matrix"], numpy.eye(4), center),
        "other": None if other is None else difference(other, numpy.eye(4), center),
    }


def report(text, results):
    text.add(
        f"`frangia inspect MESH.ply --reference SCAN/truth.ply --align best-fit` on the mesh of a simulated scan, {STARTS} times in any orientation, 500 mm away. A start is right within 0.005 mm and 0.01 degrees of the pose that the mesh has without a move. The difference of that pose from the frame of the truth holds the registration of the scan; CloudCompare's is that of its ICP, which began at the truth, with all points (package cloudcompare).\n"
    )
    text.table(
        "part",
        "right",
        "largest difference, mm",
        "largest, degrees",
        "overlap",
        "RMS, mm",
        "from the truth, mm",
        "degrees",
        "CloudCompare, mm",
        "degrees",
    )
    for part in PARTS:
        (one,) = results[part]
        right = sum(mm <= 0.005 and degrees <= 0.01 for mm, degrees in one["off"])
        worst = [max(values) for values in zip(*one["off"])]
        theirs = ("not installed", "") if one["other"] is None else (f"{value:.4f}" for value in one["other"])
        text.row(
            part,
            f"{right} of {STARTS}",
            f"{worst[0]:.4f}",
            f"{worst[1]:.4f}",
            f"{one['overlap']:.3f}",
            f"{one['rms_mm']:.4f}",
            *(f"{value:.4f}" for value in one["frame"]),
            *theirs,
        )
    text.add("\nParts with symmetries:\n")
    text.table("part", "answer")
    for part in SYMMETRIC:
        text.row(part, results[part][0])
