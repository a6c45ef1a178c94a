"""Simulated scans of every part against the true surface."""
TITLE = "Simulated scans against their truth"

SCANS = [
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
]
CASES = {f"{part} {rig}": 1 for part, rig in SCANS}


def measure(study, case, seed):
    part, rig = case.split()
    scan = study.digital(part, rig)
    mesh, answer = study.reconstructed(scan)
    compare = ("inspect", mesh, "--reference", scan / "truth.ply", "--scan", scan)
    return {
        "points": answer["points"],
        "error": study.run(*compare),
        "completeness_60": study.run(*compare, "--max-angle", 60)["completeness"],
    }


def report(text, results):
    text.add(
        "`frangia simulate PART --rig RIG --samples 4 -o SCAN`, `frangia reconstruct SCAN -o MESH.ply`, `frangia inspect MESH.ply --reference SCAN/truth.ply --scan SCAN`. Completeness: share of the measurable surface (seen by camera and projector of one view within 75 or 60 degrees of the normal) that has mesh within 0.2 mm. Error over sigma: RMS of each vertex's error divided by its predicted sigma, wanted 0.8 to 1.25. Defects: non-manifold edges and inward-facing triangles, wanted none. The carducci rig is that of the paper: f 12.5 mm, 20 degrees, camera at 490 mm, projector at 1000 mm, 1 fringe per degree, 512 x 512, 8 views.\n"
    )
    text.table(
        "part",
        "rig",
        "points",
        "RMS mm",
        "99 % mm",
        "maximum mm",
        "completeness, 75",
        "completeness, 60",
        "error over sigma",
        "defects",
    )
    for case, (result,) in results.items():
        error = result["error"]
        text.row(
            *case.split(),
            result["points"],
            f"{error['rms_mm']:.4f}",
            f"{error['p99_mm']:.4f}",
            f"{error['max_mm']:.3f}",
            f"{100 * error['completeness']:.1f} %",
            f"{100 * result['completeness_60']:.1f} %",
            f"{error['sigma_ratio']:.2f}",
            f"{error['non_manifold_edges']}, {error['inward_triangles']}",
        )
