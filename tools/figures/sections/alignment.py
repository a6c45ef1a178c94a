"""Best fits of simulated parts from random starts."""
import numpy

from surfaces import points_of, read_ply, read_triangles

TITLE = "Best fit from random starts"
PAGE = "inspection.md"

STARTS = 40
PARTS = ["bust", "blade", "bracket", "shaft"]


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
    lines += [f"property {types[moved.dtype[name].str[1:]]} {name}" for name in moved.dtype.names if name not in ("nx", "ny", "nz")]
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
    angle = numpy.degrees(numpy.linalg.norm([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]]) / 2)
    return numpy.linalg.norm((a - b) @ numpy.append(center, 1.0)), angle


def measure(study):
    study.add(f"`frangia inspect MESH.ply --reference SCAN/truth.ply --align best-fit` on the mesh of a simulated scan, {STARTS} times in any orientation, 500 mm away. A start is right within 0.005 mm and 0.01 degrees of the pose that the mesh has without a move. Its own difference from the frame of the truth is that of the registered scan.\n")
    study.table("part", "right", "largest difference, mm", "largest, degrees", "overlap", "RMS, mm", "frame, mm", "frame, degrees")
    for part in PARTS:
        scan = study.simulated(part)
        mesh, moved = study.work / f"align-{part}.ply", study.work / "align-moved.ply"
        study.run("reconstruct", scan, "-o", mesh)
        vertices, triangles = read_ply(mesh), read_triangles(mesh)
        center = points_of(vertices).mean(axis=0)
        plain = study.run("inspect", mesh, "--reference", scan / "truth.ply", "--align", "best-fit")["alignment"]
        generator = numpy.random.default_rng(1)
        worst = [0.0, 0.0]
        right = 0
        for _ in range(STARTS):
            rotation, shift = random_pose(generator)
            write_moved(moved, vertices, triangles, rotation, shift)
            found = study.run("inspect", moved, "--reference", scan / "truth.ply", "--align", "best-fit")["alignment"]
            motion = numpy.eye(4)
            motion[:3, :3], motion[:3, 3] = rotation, shift
            off, angle = difference(numpy.array(found["matrix"]) @ motion, plain["matrix"], center)
            right += off <= 0.005 and angle <= 0.01
            worst = [max(worst[0], off), max(worst[1], angle)]
        frame = difference(plain["matrix"], numpy.eye(4), center)
        study.row(part, f"{right} of {STARTS}", f"{worst[0]:.4f}", f"{worst[1]:.4f}", f"{plain['overlap']:.3f}", f"{plain['rms_mm']:.4f}", f"{frame[0]:.4f}", f"{frame[1]:.4f}")
