"""How far decimated meshes lie from the scan, as MeshLab measures it: a section of tools/figures.py."""
import pathlib
import re
import shutil
import subprocess
import tempfile

# MeshLab wants every parameter named.
SCRIPT = """<!DOCTYPE FilterScript>
<FilterScript>
 <filter name="Hausdorff Distance">
  <Param type="RichMesh" value="0" name="SampledMesh"/>
  <Param type="RichMesh" value="1" name="TargetMesh"/>
  <Param type="RichBool" value="false" name="SaveSample"/>
  <Param type="RichBool" value="true" name="SampleVert"/>
  <Param type="RichBool" value="true" name="SampleEdge"/>
  <Param type="RichBool" value="false" name="SampleFauxEdge"/>
  <Param type="RichBool" value="true" name="SampleFace"/>
  <Param type="RichInt" value="1000000" name="SampleNum"/>
  <Param type="RichAbsPerc" value="5" min="0" max="100" name="MaxDist"/>
 </filter>
</FilterScript>
"""


def distance(sampled, target):
    """The largest and the RMS distance, mm, from two million points of a mesh to another."""
    script = pathlib.Path(tempfile.gettempdir()) / "frangia-hausdorff.mlx"
    script.write_text(SCRIPT)
    command = ["xvfb-run", "-a", "meshlabserver", "-i", sampled, target, "-s", script]
    text = subprocess.run(list(map(str, command)), capture_output=True, text=True).stdout
    found = re.search(r"max (\S+)\s+mean : \S+\s+RMS : (\S+)", text)
    if not found:
        raise SystemExit(f"MeshLab did not measure {sampled}:\n{text}")
    return float(found[1]), float(found[2])


def decimation(tell, data):
    tell("## Decimation, judged by MeshLab")
    scan = data / "scan.ply"
    meshes = {"frangia": data / "tenth.ply", "CGAL, Garland-Heckbert": data / "tenth-by-cgal.ply"}
    missing = [path.name for path in (scan, *meshes.values()) if not path.exists()]
    missing += [name for name in ("meshlabserver", "xvfb-run") if not shutil.which(name)]
    if missing:
        tell(f"Not measured: there is no {', no '.join(missing)}. `./run bench` makes the meshes.\n")
        return
    tell("A scan of two million triangles, decimated to a tenth (`bench_mesh` writes both meshes): its vertices, a million points on its edges and about as many on its triangles, and the nearest place of the other; wanted: no farther than CGAL's.\n")
    tell("| | farthest of it from the scan, mm | RMS | farthest of the scan from it, mm | RMS |\n|---|---|---|---|---|")
    for name, mesh in meshes.items():
        (there, there_rms), (back, back_rms) = distance(mesh, scan), distance(scan, mesh)
        tell(f"| {name} | {there:.4f} | {there_rms:.4f} | {back:.4f} | {back_rms:.4f} |")
    tell()
