"""Distances of decimated meshes from the scan, measured by MeshLab."""
import os
import re
import subprocess

import meshlab
from study import ROOT, NotMeasured

TITLE = "Decimation, measured by MeshLab"

HAUSDORFF = [
    ("RichMesh", "SampledMesh", 0),
    ("RichMesh", "TargetMesh", 1),
    ("RichBool", "SaveSample", "false"),
    ("RichBool", "SampleVert", "true"),
    ("RichBool", "SampleEdge", "true"),
    ("RichBool", "SampleFauxEdge", "false"),
    ("RichBool", "SampleFace", "true"),
    ("RichInt", "SampleNum", 1000000),
    ("RichAbsPerc", "MaxDist", 5),
]


def distance(sampled, target):
    """The maximum and the RMS distance, mm, from two million points of one mesh to the other."""
    text = meshlab.apply("Hausdorff Distance", HAUSDORFF, [sampled, target])
    found = re.search(r"max (\S+)\s+mean : \S+\s+RMS : (\S+)", text)
    if not found:
        raise SystemExit(f"MeshLab did not measure {sampled}:\n{text}")
    return float(found[1]), float(found[2])


MESHES = {"frangia": "tenth.ply", "CGAL, Garland-Heckbert": "tenth-by-cgal.ply"}


def measure(study, case, seed):
    missing = meshlab.is_missing()
    if missing:
        raise NotMeasured(f"missing {', '.join(missing)}")
    study.build("bench_mesh")
    data = ROOT / "out" / "bench" / "data"
    subprocess.run(
        [ROOT / "build/release/bin/bench_mesh", "--benchmark_filter=^decimate_to"],
        check=True,
        env=dict(os.environ, FRANGIA_BENCH_DATA=str(data)),
    )
    scan = data / "scan.ply"
    return {name: [*distance(data / mesh, scan), *distance(scan, data / mesh)] for name, mesh in MESHES.items()}


def report(text, results):
    text.add(
        "A scan of two million triangles, decimated to a tenth (`bench_mesh` writes both meshes). Distances from all vertices, a million points on the edges and about as many on the triangles of one mesh to the other; wanted: no larger than those of CGAL.\n"
    )
    text.table("", "maximum from mesh to scan, mm", "RMS", "maximum from scan to mesh, mm", "RMS")
    for name, distances in results["decimation"][0].items():
        text.row(name, *(f"{one:.4f}" for one in distances))
