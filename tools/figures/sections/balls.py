"""Two spheres of 40 mm, 70 mm apart, rendered by another program."""
import numpy

from study import seconds
from surfaces import fit_sphere, points_of, read_ply

TITLE = "The ball bar"


def measure(study):
    scan = study.shared("balls")
    if not scan:
        return
    mesh = study.work / "balls.ply"
    answer = study.run("reconstruct", scan, "-o", mesh)
    points = points_of(read_ply(mesh))
    study.add("`frangia reconstruct ../shared/scans/balls -o balls.ply`; spheres fitted by least squares to the vertices above z = 47 mm and within 0.5 mm of the nominal sphere.\n")
    study.table("", "measured", "wanted")
    centres = []
    for side in (-35.0, 35.0):
        from_centre = numpy.linalg.norm(points - [0.0, side, 60.0], axis=1)
        near = points[(points[:, 2] > 47) & (numpy.abs(from_centre - 20) < 0.5)]
        centre, radius, residual = fit_sphere(near, numpy.array([0.0, side, 60.0]), 20.0)
        centres.append(centre)
        study.row(f"sphere at y = {side:.0f}: diameter, mm", f"{2 * radius:.4f}", "40 within 0.02")
        study.row("residuals of its vertices, RMS mm", f"{residual:.4f}", "at most 0.012")
    study.row("spacing, mm", f"{numpy.linalg.norm(centres[0] - centres[1]):.4f}", "70 within 0.02")
    study.add(f"\nSeconds: {seconds(answer)}; peak {answer['peak_memory_mb']:.0f} MB.")
