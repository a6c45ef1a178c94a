"""The block of the paper's rig: fringe orders from the laser sheet alone."""
import numpy

from study import seconds
from surfaces import box, cylinder, points_of, read_ply, rms

TITLE = "The paper's rig: the block, with fringe orders from the laser sheet alone"


def distance_to_block(p):
    body = numpy.maximum(box(p, [-35, -22, 0], [35, 22, 50]), -box(p, [8, -14, 36], [28, 14, 99]))
    return numpy.minimum(body, cylinder(p, -12, 0, 12, 50, 75))


def measure(study):
    mesh = study.work / "block.ply"
    answer = study.run("reconstruct", study.shared("block"), "-o", mesh)
    vertices = read_ply(mesh)
    distance = distance_to_block(points_of(vertices))
    study.add(
        "`frangia reconstruct ../shared/scans/block -o block.ply`; distances of the vertices to the analytic block. One fringe order corresponds to 28 mm of depth.\n"
    )
    study.table("", "measured", "wanted")
    study.row("RMS, mm", f"{rms(distance):.4f}", "at most 0.08")
    study.row("99 %, mm", f"{numpy.percentile(numpy.abs(distance), 99):.4f}", "")
    study.row("maximum, mm", f"{numpy.abs(distance).max():.4f}", "less than one fringe")
    study.row("RMS of error over its predicted sigma", f"{rms(distance / vertices['sigma_mm']):.2f}", "1")
    study.add(f"\nSeconds for 8 views of 512 x 512: {seconds(answer)}; peak {answer['peak_memory_mb']:.0f} MB.")
