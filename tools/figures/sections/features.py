"""Sizes of the features of simulated scans against the drawing, and how often their intervals cover it."""
import time

import numpy

TITLE = "Features"
PAGE = "inspection.md"

SEEDS = 40
# Diameters of the shaft's cylinders that the rig sees, and where along the axis they lie; that of 44 mm is in the shade
# of the flange. The model has 512 facets.
SHAFT = [(36.0, 1, 18), (52.0, 22, 37), (36.0, 38, 79), (28.0, 83, 99)]
FACETS = 512


def modelled(diameter):
    """The diameter whose cylinder fits the facets best: their mean distance from the axis."""
    half = numpy.pi / FACETS
    return diameter * (2.0 * numpy.cos(half) + 1.0) / 3.0


def cylinder_at(features, diameter, low, high):
    """The cylinder of a nominal size whose center lies between two heights."""
    found = [f for f in features if f["kind"] == "cylinder" and low < f["center_mm"][2] < high and abs(f["diameter_mm"] - diameter) < 1]
    return max(found, key=lambda f: f["points"], default=None)


def measure(study):
    study.add(f"`frangia simulate shaft --seed N -o SCAN`, `frangia reconstruct SCAN -o MESH.ply`, `frangia inspect MESH.ply --features`; {SEEDS} seeds. The truth is the cylinder that fits the facets of the simulated part.\n")
    study.table("diameter, mm", "found", "within its interval", "mean error, mm", "spread, mm", "mean U95, mm", "U95 over 1.96 spread")
    errors, intervals = {cylinder: [] for cylinder in SHAFT}, {cylinder: [] for cylinder in SHAFT}
    for seed in range(1, SEEDS + 1):
        mesh = study.work / f"shaft-{seed}.ply"
        if not mesh.exists():
            scan = study.made(f"shaft-features-{seed}", "simulate", "shaft", "--seed", seed)
            study.run("reconstruct", scan, "-o", mesh)
        features = study.run("inspect", mesh, "--features")["features"]
        for cylinder in SHAFT:
            found = cylinder_at(features, *cylinder)
            if found:
                errors[cylinder].append(found["diameter_mm"] - modelled(cylinder[0]))
                intervals[cylinder].append(found["u95_mm"])
    covered = total = 0
    for cylinder in SHAFT:
        error, u95 = numpy.array(errors[cylinder]), numpy.array(intervals[cylinder])
        inside = int((abs(error) <= u95).sum())
        covered, total = covered + inside, total + len(error)
        spread = error.std(ddof=1)
        study.row(f"{cylinder[0]:.0f} at z = {cylinder[1]} to {cylinder[2]}", len(error), f"{inside} of {len(error)}", f"{error.mean():+.4f}",
                  f"{spread:.4f}", f"{u95.mean():.4f}", f"{u95.mean() / (1.96 * spread):.2f}")
    ratio = numpy.mean([numpy.mean(intervals[c]) / (1.96 * numpy.std(errors[c], ddof=1)) for c in SHAFT])
    study.add(f"\nPooled: {covered} of {total} ({100 * covered / max(total, 1):.1f} %), wanted 92 to 98 %; intervals {ratio:.2f} times those from the spread, wanted at most 1.2.")

    mesh = study.work / "balls-features.ply"
    study.run("reconstruct", study.shared("balls"), "-o", mesh)
    begin = time.monotonic()
    features = study.run("inspect", mesh, "--features")["features"]
    seconds = time.monotonic() - begin
    spheres = [f for f in features if f["kind"] == "sphere" and abs(f["diameter_mm"] - 40) < 1]
    study.add("\n`frangia inspect balls.ply --features` on the mesh of ../shared/scans/balls:\n")
    study.table("", "measured, mm", "wanted, mm")
    for sphere in spheres:
        study.row("sphere", f"{sphere['diameter_mm']:.4f} ± {sphere['u95_mm']:.4f}", "40 within 0.01")
    centers = [numpy.array(sphere["center_mm"]) for sphere in spheres]
    if len(centers) == 2:
        study.row("spacing", f"{numpy.linalg.norm(centers[0] - centers[1]):.4f}", "70 within 0.01")
    study.add(f"\nSeconds with reading: {seconds:.1f}.")
