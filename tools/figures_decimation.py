"""Distances of decimated meshes from the scan, measured by MeshLab: a section of tools/figures.py."""
import re

import meshlab

HAUSDORFF = [("RichMesh", "SampledMesh", 0), ("RichMesh", "TargetMesh", 1), ("RichBool", "SaveSample", "false"),
             ("RichBool", "SampleVert", "true"), ("RichBool", "SampleEdge", "true"),
             ("RichBool", "SampleFauxEdge", "false"), ("RichBool", "SampleFace", "true"),
             ("RichInt", "SampleNum", 1000000), ("RichAbsPerc", "MaxDist", 5)]


def distance(sampled, target):
    """The maximum and the RMS distance, mm, from two million points of one mesh to the other."""
    text = meshlab.apply("Hausdorff Distance", HAUSDORFF, [sampled, target])
    found = re.search(r"max (\S+)\s+mean : \S+\s+RMS : (\S+)", text)
    if not found:
        raise SystemExit(f"MeshLab did not measure {sampled}:\n{text}")
    return float(found[1]), float(found[2])


def decimation(add, data):
    add("## Decimation, measured by MeshLab")
    scan = data / "scan.ply"
    meshes = {"frangia": data / "tenth.ply", "CGAL, Garland-Heckbert": data / "tenth-by-cgal.ply"}
    missing = [path.name for path in (scan, *meshes.values()) if not path.exists()]
    missing += meshlab.is_missing()
    if missing:
        add(f"Not measured: missing {', '.join(missing)}. `./run bench` makes the meshes.\n")
        return
    add("A scan of two million triangles, decimated to a tenth (`bench_mesh` writes both meshes). Distances from all vertices, a million points on the edges and about as many on the triangles of one mesh to the other; wanted: no larger than those of CGAL.\n")
    add("| | maximum from mesh to scan, mm | RMS | maximum from scan to mesh, mm | RMS |\n|---|---|---|---|---|")
    for name, mesh in meshes.items():
        (there, there_rms), (back, back_rms) = distance(mesh, scan), distance(scan, mesh)
        add(f"| {name} | {there:.4f} | {there_rms:.4f} | {back:.4f} | {back_rms:.4f} |")
    add()
