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
    mesh, filled = study.work / "edit-bar.ply", study.work / "edit-filled.ply"
    study.run("reconstruct", study.simulated("ball-bar"), "-o", mesh)
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
        study.row(
            f"a filled hole of 20 mm in a sphere of 40 mm: maximum distance of {len(patch)} vertices from the sphere, mm",
            f"{off.max():.3f}",
            "at most 0.15",
        )


def smoothed_noise(study, mesh):
    noisy, smooth = study.work / "edit-noisy.ply", study.work / "edit-smooth.ply"
    points, triangles = points_of(read_ply(mesh)), read_triangles(mesh)
    normals = vertex_normals(points, triangles)
    spread = 0.02 * numpy.random.default_rng(1).standard_normal(len(points))
    write_noisy(noisy, points + spread[:, None] * normals, triangles, 0.02)
    for steps in SMOOTHING:
        study.run("edit", noisy, *steps, "-o", smooth)
        left = ((points_of(read_ply(smooth)) - points) * normals).sum(axis=1)
        study.row(
            f"noise of the bust after `{words(steps)}`, relative to before",
            f"{rms(left) / rms(spread):.2f}",
            "at most 0.5",
        )


def smoothed_edges(study):
    block, smooth = sharp_block.fused_block(study), study.work / "edit-smooth.ply"
    before = points_of(read_ply(block))
    on_edge = sharp_block.distance_to_edges(before) < 0.06
    for steps in SMOOTHING:
        study.run("edit", block, *steps, "-o", smooth)
        moved = numpy.linalg.norm(points_of(read_ply(smooth))[on_edge] - before[on_edge], axis=1)
        study.row(
            f"maximum displacement by `{words(steps)}` of {on_edge.sum()} vertices on the edges of the block, mm",
            f"{moved.max():.3f}",
            "at most 0.03",
        )


def smoothed_dim_scan(study, clean_scan, clean_mesh):
    dim, mesh, smooth, clean = (
        study.simulated("bust", "digital", "bust-dim", "--exposure", 0.08),
        study.work / "edit-dim.ply",
        study.work / "edit-smooth.ply",
        study.work / "edit-clean.ply",
    )
    study.run("edit", clean_mesh, "-o", clean)
    study.run("reconstruct", dim, "-o", mesh)
    for steps in ([], ["--smooth", 10], ["--smooth", 25], ["--smooth-keeping-edges", 4], ["--smooth-keeping-edges", 6]):
        after = f" after `{words(steps)}`" if steps else ""
        study.run("edit", mesh, *steps, "-o", smooth)
        error = study.run("inspect", smooth, "--reference", dim / "truth.ply")
        study.run("edit", clean, "--max-sigmas", 0, *steps, "-o", smooth)
        lost = study.run("inspect", smooth, "--reference", clean_scan / "truth.ply")
        study.row(f"the bust with little light{after}: error, RMS mm", f"{error['rms_mm']:.4f}", "")
        study.row(
            f"the bust without noise{after}, with unlimited displacement: error, RMS mm", f"{lost['rms_mm']:.4f}", ""
        )


def measure(study):
    study.add(
        "Results of `frangia edit` on simulated scans, digital rig, 8 views. The bust is scanned without noise; then independent noise of 0.02 mm RMS displaces every vertex along its normal, and the remaining displacement along that normal is measured. The last rows compare a scan with a twelfth of the light (`--exposure 0.08`) with the true surface: part of its noise has wavelengths longer than an edge, so smoothing that removes it also removes shape. The rows without noise state how much shape. The block is the one with sharp edges above.\n"
    )
    study.table("", "measured", "wanted")
    filled_holes(study)
    clean_scan, clean_mesh = (
        study.simulated("bust", "digital", "bust-clean", "--no-noise"),
        study.work / "edit-head.ply",
    )
    study.run("reconstruct", clean_scan, "-o", clean_mesh)
    smoothed_noise(study, clean_mesh)
    smoothed_edges(study)
    smoothed_dim_scan(study, clean_scan, clean_mesh)
