"""What edits do to meshes whose truth is known: filled holes, removed noise, edges that stay."""
import numpy

import sharp_block
from surfaces import fit_ball, points_of, read_ply, read_triangles, rms, vertex_normals

TITLE = "Edits"

SMOOTHING = (["--smooth", 10], ["--smooth-keeping-edges", 4])


def words(steps):
    return " ".join(map(str, steps))


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


def filled_holes(study):
    mesh, filled, rows = study.reconstructed(study.digital("ball-bar"))[0], study.work / "filled.ply", []
    points = points_of(read_ply(mesh))
    for side in (-35.0, 35.0):
        centre, radius, _ = fit_ball(points, [0.0, side, 60.0])
        top = centre + radius * numpy.array([0.0, numpy.sign(side) * 0.6, 0.8])
        ball = ",".join(f"{x:.4f}" for x in top) + ",10"
        study.run(
            "edit",
            mesh,
            "--remove-islands",
            "5mm",
            "--select-ball",
            ball,
            "--delete",
            "--fill-holes",
            "25mm",
            "-o",
            filled,
        )
        vertices = read_ply(filled)
        patch = points_of(vertices[vertices["mark"] == 2])
        patch = patch[numpy.linalg.norm(patch - top, axis=1) < 11]
        off = numpy.abs(numpy.linalg.norm(patch - centre, axis=1) - radius)
        rows.append(
            [
                f"a filled hole of 20 mm in a sphere of 40 mm: maximum distance of {len(patch)} vertices from the sphere, mm",
                f"{off.max():.3f}",
                "at most 0.15",
            ]
        )
    return rows


def clean_bust(study):
    """The scan of the bust without noise, and its mesh."""
    scan = study.digital("bust", "digital", "--no-noise")
    return scan, study.reconstructed(scan)[0]


def smoothed_noise(study):
    noisy, smooth, rows = study.work / "noisy.ply", study.work / "smooth.ply", []
    mesh = clean_bust(study)[1]
    points, triangles = points_of(read_ply(mesh)), read_triangles(mesh)
    normals = vertex_normals(points, triangles)
    spread = 0.02 * numpy.random.default_rng(1).standard_normal(len(points))
    write_noisy(noisy, points + spread[:, None] * normals, triangles, 0.02)
    for steps in SMOOTHING:
        study.run("edit", noisy, *steps, "-o", smooth)
        left = ((points_of(read_ply(smooth)) - points) * normals).sum(axis=1)
        rows.append(
            [
                f"noise of the bust after `{words(steps)}`, relative to before",
                f"{rms(left) / rms(spread):.2f}",
                "at most 0.5",
            ]
        )
    return rows


def smoothed_edges(study):
    block, smooth, rows = sharp_block.fused_block(study), study.work / "smooth.ply", []
    before = points_of(read_ply(block))
    on_edge = sharp_block.distance_to_edges(before) < 0.06
    for steps in SMOOTHING:
        study.run("edit", block, *steps, "-o", smooth)
        moved = numpy.linalg.norm(points_of(read_ply(smooth))[on_edge] - before[on_edge], axis=1)
        rows.append(
            [
                f"maximum displacement by `{words(steps)}` of {on_edge.sum()} vertices on the edges of the block, mm",
                f"{moved.max():.3f}",
                "at most 0.03",
            ]
        )
    return rows


def smoothed_dim_scan(study):
    clean, smooth, rows = study.work / "clean.ply", study.work / "smooth.ply", []
    clean_scan, clean_mesh = clean_bust(study)
    study.run("edit", clean_mesh, "-o", clean)
    dim = study.digital("bust", "digital", "--exposure", 0.08)
    mesh, _ = study.reconstructed(dim)
    for steps in ([], ["--smooth", 10], ["--smooth", 25], ["--smooth-keeping-edges", 4], ["--smooth-keeping-edges", 6]):
        after = f" after `{words(steps)}`" if steps else ""
        study.run("edit", mesh, *steps, "-o", smooth)
        error = study.run("inspect", smooth, "--reference", dim / "truth.ply")
        study.run("edit", clean, "--max-sigmas", 0, *steps, "-o", smooth)
        lost = study.run("inspect", smooth, "--reference", clean_scan / "truth.ply")
        rows += [
            [f"the bust with little light{after}: error, RMS mm", f"{error['rms_mm']:.4f}", ""],
            [f"the bust without noise{after}, with unlimited displacement: error, RMS mm", f"{lost['rms_mm']:.4f}", ""],
        ]
    return rows


EDITS = {"holes": filled_holes, "noise": smoothed_noise, "edges": smoothed_edges, "little light": smoothed_dim_scan}
CASES = {case: 1 for case in EDITS}


def measure(study, case, seed):
    return EDITS[case](study)


def report(text, results):
    text.add(
        "Results of `frangia edit` on simulated scans, digital rig, 8 views. The bust is scanned without noise; then independent noise of 0.02 mm RMS displaces every vertex along its normal, and the remaining displacement along that normal is measured. The last rows compare a scan with a twelfth of the light (`--exposure 0.08`) with the true surface: part of its noise has wavelengths longer than an edge, so smoothing that removes it also removes shape. The rows without noise state how much shape. The block is the one with sharp edges above.\n"
    )
    text.table("", "measured", "wanted")
    for (rows,) in results.values():
        for row in rows:
            text.row(*row)
