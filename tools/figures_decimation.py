"""How far decimated meshes lie from the scan, as MeshLab measures it: a section of tools/figures.py."""
import re

import meshlab

HAUSDORFF = [("RichMesh", "SampledMesh", 0), ("RichMesh", "TargetMesh", 1), ("RichBool", "SaveSample", "false"),
             ("RichBool", "SampleVert", "true"), ("RichBool", "SampleEdge", "true"),
             ("RichBool", "SampleFauxEdge", "false"), ("RichBool", "SampleFace", "true"),
             ("RichInt", "SampleNum", 1000000), ("RichAbsPerc", "MaxDist", 5)]


def distance(sampled, target):
    """The largest and the RMS distance, mm, from two million points of a mesh to another."""
    text = meshlab.apply("Hausdorff Distance", HAUSDORFF, [sampled, target])
    found = re.search(r"max (\S+)\s+mean : \S+\s+RMS : (\S+)", text)
    if not found:
        raise SystemExit(f"MeshLab did not measure {sampled}:\n{text}")
    return float(found[1]), float(found[2])


def decimation(tell, data):
    tell("## Decimation, judged by MeshLab")
    scan = data / "scan.ply"
    meshes = {"frangia": data / "tenth.ply", "CGAL, Garland-Heckbert": data / "tenth-by-cgal.ply"}
    missing = [path.name for path in (scan, *meshes.values()) if not path.exists()]
    missing += meshlab.is_missing()
    if missing:
        tell(f"Not measured: there is no {', no '.join(missing)}. `./run bench` makes the meshes.\n")
        return
    tell("A scan of two million triangles, decimated to a tenth (`bench_mesh` writes both meshes): its vertices, a million points on its edges and about as many on its triangles, and the nearest place of the other; wanted: no farther than CGAL's.\n")
    tell("| | farthest of it from the scan, mm | RMS | farthest of the scan from it, mm | RMS |\n|---|---|---|---|---|")
    for name, mesh in meshes.items():
        (there, there_rms), (back, back_rms) = distance(mesh, scan), distance(scan, mesh)
        tell(f"| {name} | {there:.4f} | {there_rms:.4f} | {back:.4f} | {back_rms:.4f} |")
    tell()
