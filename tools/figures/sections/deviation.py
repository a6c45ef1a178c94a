"""Deviations of 2 million vertices from a million triangles, their time, and CloudCompare's C2M beside them."""
import shutil
import subprocess
import time

import numpy

from surfaces import points_of, read_ply

TITLE = "Deviations of large meshes"
PAGE = "inspection.md"


def write_surface(path, around, along, noise_mm, seed):
    """A wavy body of about 100 mm as PLY; its ends are open."""
    u = numpy.linspace(0, 2 * numpy.pi, around, endpoint=False)
    v = numpy.linspace(0.02, numpy.pi - 0.02, along)
    u, v = numpy.meshgrid(u, v, indexing="ij")
    radius = 50 * (1 + 0.15 * numpy.sin(3 * u) * numpy.sin(v) ** 2 + 0.1 * numpy.cos(5 * v))
    radius = radius + numpy.random.default_rng(seed).normal(0, noise_mm, radius.shape)
    points = numpy.stack(
        [radius * numpy.sin(v) * numpy.cos(u), radius * numpy.sin(v) * numpy.sin(u), radius * numpy.cos(v)], -1
    )
    i, k = numpy.arange(around)[:, None], numpy.arange(along - 1)[None, :]
    a, b = (i * along + k).ravel(), ((i + 1) % around * along + k).ravel()
    triangles = numpy.concatenate([numpy.stack([a, a + 1, b], 1), numpy.stack([b, a + 1, b + 1], 1)])
    faces = numpy.empty(len(triangles), [("n", "u1"), ("v", "<i4", 3)])
    faces["n"], faces["v"] = 3, triangles
    head = f"ply\nformat binary_little_endian 1.0\nelement vertex {around * along}\n"
    head += "".join(f"property float {axis}\n" for axis in "xyz")
    head += f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n"
    path.write_bytes(head.encode() + points.reshape(-1, 3).astype("<f4").tobytes() + faces.tobytes())


def cloud_compare(study, points, reference):
    """C2M of CloudCompare and its seconds; none without the program."""
    if not (shutil.which("CloudCompare") and shutil.which("xvfb-run")):
        return None
    cloud, out = study.work / "deviation-cloud.ply", study.work / "deviation-c2m.asc"
    head = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\n"
    head += "".join(f"property float {axis}\n" for axis in "xyz") + "end_header\n"
    cloud.write_bytes(head.encode() + points.astype("<f4").tobytes())
    begin = time.monotonic()
    subprocess.run(
        [
            "xvfb-run",
            "-a",
            "CloudCompare",
            "-SILENT",
            "-AUTO_SAVE",
            "OFF",
            "-C_EXPORT_FMT",
            "ASC",
            "-PREC",
            "9",
            "-O",
            cloud,
            "-O",
            reference,
            "-C2M_DIST",
            "-SAVE_CLOUDS",
            "FILE",
            out,
        ],
        check=True,
        stdout=subprocess.DEVNULL,
    )
    return numpy.loadtxt(out)[:, -1], time.monotonic() - begin


def measure(study, case, seed):
    reference, mesh = study.work / "deviation-reference.ply", study.work / "deviation-mesh.ply"
    write_surface(reference, 1000, 501, 0.0, 1)
    write_surface(mesh, 2000, 1000, 0.02, 2)
    out = study.work / "deviation-out.ply"
    answers = [study.run("inspect", mesh, "--reference", reference, "-o", out) for _ in range(3)]
    vertices = read_ply(out)
    deviation = vertices["deviation_mm"]
    result = {
        "seconds": min(answer["seconds"]["deviation"] for answer in answers),
        "compared": int(numpy.isfinite(deviation).sum()),
    }
    other = cloud_compare(study, points_of(vertices), reference)
    if other is not None:
        distances, their_seconds = other
        both = numpy.isfinite(deviation) & numpy.isfinite(distances)
        result["other"] = {
            "seconds": their_seconds,
            "compared": int(both.sum()),
            "difference_mm": float(abs(deviation - distances)[both].max()),
        }
    return result


def report(text, results):
    result = results["deviation"][0]
    text.add(
        "`frangia inspect MESH --reference REFERENCE -o OUT.ply`, 2 000 000 vertices against 1 000 000 triangles; seconds "
        "without reading and the search tree of the reference, the best of three.\n"
    )
    text.table("program", "seconds", "largest difference, mm", "compared vertices")
    text.row("frangia", f"{result['seconds']:.2f}", "", result["compared"])
    other = result.get("other")
    if other is None:
        text.add("\nCloudCompare (Debian's package cloudcompare) was not installed.")
        return
    text.row(
        "CloudCompare, C2M, with reading", f"{other['seconds']:.2f}", f"{other['difference_mm']:.6f}", other["compared"]
    )
