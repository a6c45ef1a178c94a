"""Two spheres of 40 mm, 70 mm apart, rendered by another program."""
import numpy

from study import seconds
from surfaces import fit_ball, points_of, read_ply

TITLE = "The ball bar"
SIDES = (-35, 35)


def measure(study, case, seed):
    mesh, answer = study.reconstructed(study.shared("balls"))
    points = points_of(read_ply(mesh))
    return {"answer": answer, "balls": [fit_ball(points, [0.0, side, 60.0]) for side in SIDES]}


def report(text, results):
    result = results["balls"][0]
    text.add(
        "`frangia reconstruct ../shared/scans/balls -o balls.ply`; spheres fitted by least squares to the vertices above z = 47 mm and within 0.5 mm of the nominal sphere.\n"
    )
    text.table("", "measured", "wanted")
    for side, (_, radius, residual) in zip(SIDES, result["balls"]):
        text.row(f"sphere at y = {side}: diameter, mm", f"{2 * radius:.4f}", "40 within 0.02")
        text.row("residuals of its vertices, RMS mm", f"{residual:.4f}", "at most 0.012")
    spacing = numpy.linalg.norm(numpy.subtract(*(ball[0] for ball in result["balls"])))
    text.row("spacing, mm", f"{spacing:.4f}", "70 within 0.02")
    text.add(f"\nSeconds: {seconds(result['answer'])}; peak {result['answer']['peak_memory_mb']:.0f} MB.")
