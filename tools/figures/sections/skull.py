"""The real skull against the mesh that its owners published."""
import numpy
from scipy.spatial import cKDTree

from study import seconds
from surfaces import points_of, read_ply

TITLE = "A real scan: the skull"


def measure(study, case, seed):
    mesh, answer = study.reconstructed(study.shared("skull"))
    reference = points_of(read_ply(study.shared("skull") / "reference.ply"))
    distance = cKDTree(reference).query(points_of(read_ply(mesh)))[0]
    return {"answer": answer, "median_mm": numpy.median(distance)}


def report(text, results):
    result = results["skull"][0]
    answer = result["answer"]
    text.add(
        "`frangia reconstruct ../shared/scans/skull -o skull.ply`; distances to the nearest point of its `reference.ply`, which is itself coarse.\n"
    )
    text.table("", "measured", "wanted")
    text.row("points", answer["points"], "at least 300 000")
    text.row("vertices, triangles", f"{answer['vertices']}, {answer['triangles']}", "")
    text.row("median distance of a vertex, mm", f"{result['median_mm']:.3f}", "at most 0.40")
    text.add(f"\nSeconds: {seconds(answer)}; peak {answer['peak_memory_mb']:.0f} MB.")
