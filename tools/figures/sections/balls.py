"""Two spheres of 40 mm, 70 mm apart, rendered by another program."""
import numpy

from study import seconds
from surfaces import fit_ball, points_of, read_ply

TITLE = "The ball bar"


def measure(study):
    mesh = study.work / "balls.ply"
    answer = study.run("reconstruct", study.shared("balls"), "-o", mesh)
    points = points_of(read_ply(mesh))
    study.add(
        "`frangia reconstruct ../shared/scans/balls -o balls.ply`; spheres fitted by least squares to the vertices above z = 47 mm and within 0.5 mm of the nominal sphere.\n"
    )
    study.table("", "measured", "wanted")
    centres = []
    for side in (-35.0, 35.0):
        centre, radius, residual = fit_ball(points, [0.0, side, 60.0])
        centres.append(centre)
        study.row(f"sphere at y = {side:.0f}: diameter, mm", f"{2 * radius:.4f}", "40 within 0.02")
        study.row("residuals of its vertices, RMS mm", f"{residual:.4f}", "at most 0.012")
    study.row("spacing, mm", f"{numpy.linalg.norm(centres[0] - centres[1]):.4f}", "70 within 0.02")
    study.add(f"\nSeconds: {seconds(answer)}; peak {answer['peak_memory_mb']:.0f} MB.")
