"""The block of the paper's rig: fringe orders from the laser sheet alone."""
import numpy

from study import seconds
from surfaces import box, cylinder, points_of, read_ply, rms

TITLE = "The paper's rig: the block, with fringe orders from the laser sheet alone"


def distance_to_block(p):
    body = numpy.maximum(box(p, [-35, -22, 0], [35, 22, 50]), -box(p, [8, -14, 36], [28, 14, 99]))
    return numpy.minimum(body, cylinder(p, -12, 0, 12, 50, 75))


def measure(study, case, seed):
    mesh, answer = study.reconstructed(study.shared("block"))
    vertices = read_ply(mesh)
    distance = distance_to_block(points_of(vertices))
    return {
        "answer": answer,
        "rms_mm": rms(distance),
        "p99_mm": numpy.percentile(numpy.abs(distance), 99),
        "max_mm": numpy.abs(distance).max(),
        "over_sigma": rms(distance / vertices["sigma_mm"]),
    }


def report(text, results):
    result = results["paper_block"][0]
    text.add(
        "`frangia reconstruct ../shared/scans/block -o block.ply`; distances of the vertices to the analytic block. One fringe order corresponds to 28 mm of depth.\n"
    )
    text.table("", "measured", "wanted")
    text.row("RMS, mm", f"{result['rms_mm']:.4f}", "at most 0.08")
    text.row("99 %, mm", f"{result['p99_mm']:.4f}", "")
    text.row("maximum, mm", f"{result['max_mm']:.4f}", "less than one fringe")
    text.row("RMS of error over its predicted sigma", f"{result['over_sigma']:.2f}", "1")
    text.add(
        f"\nSeconds for 8 views of 512 x 512: {seconds(result['answer'])}; peak {result['answer']['peak_memory_mb']:.0f} MB."
    )
