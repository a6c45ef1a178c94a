"""The real skull against the mesh that its owners published."""
import numpy
from scipy.spatial import cKDTree

from study import seconds
from surfaces import points_of, read_ply

TITLE = "A real scan: the skull"


def measure(study):
    mesh = study.work / "skull.ply"
    answer = study.run("reconstruct", study.shared("skull"), "-o", mesh)
    reference = points_of(read_ply(study.shared("skull") / "reference.ply"))
    distance = cKDTree(reference).query(points_of(read_ply(mesh)))[0]
    study.add(
        "`frangia reconstruct ../shared/scans/skull -o skull.ply`; distances to the nearest point of its `reference.ply`, which is itself coarse.\n"
    )
    study.table("", "measured", "wanted")
    study.row("points", answer["points"], "at least 300 000")
    study.row("vertices, triangles", f"{answer['vertices']}, {answer['triangles']}", "")
    study.row("median distance of a vertex, mm", f"{numpy.median(distance):.3f}", "at most 0.40")
    study.add(f"\nSeconds: {seconds(answer)}; peak {answer['peak_memory_mb']:.0f} MB.")
