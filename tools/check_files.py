"""Reads the files that the program writes with other programs and updates the table between the markers
of docs/files.md: python3 tools/check_files.py PROGRAM docs/files.md [READER...]

A closed mesh and an open mesh with marks are written in every format. A cell states whether the reader
finds all triangles (all points, in clouds) of both. Rows of readers that are not installed, or not among
those named, stay as they are.
"""
import json
import math
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parent / "figures"))

from scans import Scans  # noqa: E402

PROGRAM = pathlib.Path(sys.argv[1]).resolve()
PAGE = pathlib.Path(sys.argv[2])
ONLY = set(sys.argv[3:])
HERE = pathlib.Path(__file__).resolve().parent.parent
WORK = pathlib.Path(tempfile.mkdtemp(prefix="frangia-check-files-"))
BEGIN, END = "<!-- readers begin -->", "<!-- readers end -->"

FORMATS = {  # column: file, options of frangia edit
    "DXF faces": ("faces.dxf", []),
    "DXF polyface": ("polyface.dxf", ["--dxf", "polyface"]),
    "DXF mesh": ("mesh.dxf", ["--dxf", "mesh"]),
    "STL": ("part.stl", []),
    "STL text": ("text.stl", ["--stl-text"]),
    "PLY": ("part.ply", []),
    "OBJ": ("part.obj", []),
    "GLB": ("part.glb", []),
    "glTF": ("part.gltf", []),
    "3MF": ("part.3mf", []),
    "OFF": ("part.off", []),
    "XYZ": ("part.xyz", []),
    "PCD": ("part.pcd", []),
}


def program(*arguments):
    answer = subprocess.run([PROGRAM, "--json", *map(str, arguments)], check=True, capture_output=True, text=True)
    return json.loads(answer.stdout) if answer.stdout.startswith("{") else {}


def ask(*command):
    """Standard output and error of a program; empty when it cannot start or takes more than 15 minutes."""
    try:
        answer = subprocess.run(
            list(map(str, command)), capture_output=True, text=True, timeout=900, errors="replace", cwd=WORK
        )
    except (OSError, subprocess.TimeoutExpired):
        return ""
    return answer.stdout + answer.stderr


def number(pattern, text):
    found = re.search(pattern, text)
    return int(found.group(1)) if found else None


def assimp(path):
    return number(r"\nFaces:\s+(\d+)", ask("assimp", "info", path))


def python(module, script):
    return lambda path: number(r"(?m)^(\d+)", ask("/usr/bin/python3", "-c", f"import {module}\n{script}", path))


def script(name):
    return lambda path: number(r"(?m)^(\d+)", ask("/usr/bin/python3", HERE / "tests" / "files" / name, path))


def meshlab(path):
    text = ask("xvfb-run", "-a", "meshlabserver", "-i", path, "-o", WORK / "meshlab.ply")
    return number(r"loaded has (\d+) vn" if path.suffix == ".xyz" else r"loaded has \d+ vn (\d+) fn", text)


def cloud_compare(path):
    text = ask("xvfb-run", "-a", "CloudCompare", "-SILENT", "-O", path)
    points = number(r"Found one cloud with (\d+) points", text)
    if points and path.suffix != ".xyz":
        return "points alone"
    return points or number(r"Found one mesh with (\d+) faces", text)


def prusa(path):
    return number(r"number_of_facets\s*=\s*(\d+)", ask("prusa-slicer", "--info", path))


# The glTF importer of Debian 12 uses numpy.bool, which its NumPy no longer has.
BLENDER = """
import bpy, sys, numpy
numpy.bool = bool
path = sys.argv[-1]
bpy.ops.wm.read_factory_settings(use_empty=True)
if path.endswith('.dxf'):
    bpy.ops.preferences.addon_enable(module='io_import_dxf')
kinds = {'stl': lambda: bpy.ops.import_mesh.stl(filepath=path), 'ply': lambda: bpy.ops.import_mesh.ply(filepath=path),
         'obj': lambda: bpy.ops.wm.obj_import(filepath=path), 'glb': lambda: bpy.ops.import_scene.gltf(filepath=path),
         'gltf': lambda: bpy.ops.import_scene.gltf(filepath=path), 'dxf': lambda: bpy.ops.import_scene.dxf(filepath=path)}
kinds[path.rsplit('.', 1)[1]]()
print('FACES', sum(len(o.data.polygons) for o in bpy.data.objects if o.type == 'MESH'))
"""


def blender(path):
    return number(r"FACES (\d+)", ask("blender", "-b", "--python-expr", BLENDER, "--", path))


# MeshLab 2020.09 of Debian 12 crashes on any OBJ, even of one triangle, so OBJ is not among its columns.
READERS = {  # name: (is it installed, how to count, columns)
    "assimp": (
        shutil.which("assimp"),
        assimp,
        ["DXF faces", "DXF polyface", "STL", "STL text", "PLY", "OBJ", "GLB", "glTF", "3MF", "OFF"],
    ),
    "ezdxf": (
        ask("/usr/bin/python3", "-c", "import ezdxf; print(1)").strip() == "1",
        script("check_ezdxf.py"),
        ["DXF faces", "DXF polyface", "DXF mesh"],
    ),
    "lib3mf": (
        ask("/usr/bin/python3", "-c", "import ctypes; ctypes.CDLL('lib3MF.so.1'); print(1)").strip() == "1",
        script("check_3mf.py"),
        ["3MF"],
    ),
    "admesh": (
        shutil.which("admesh"),
        lambda path: number(r"Number of facets\s+:\s+(\d+)", ask("admesh", "-e", path)),
        ["STL", "STL text"],
    ),
    "NumPy": (True, python("numpy, sys", "print(len(numpy.loadtxt(sys.argv[1])))"), ["XYZ"]),
    "PCL": (
        ask("/usr/bin/python3", "-c", "import pcl; print(1)").strip() == "1",
        python("pcl, sys", "print(pcl.load(sys.argv[1]).size)"),
        ["PCD"],
    ),
    "MeshLab": (
        shutil.which("meshlabserver") and shutil.which("xvfb-run"),
        meshlab,
        ["STL", "STL text", "PLY", "OFF", "XYZ"],
    ),
    "CloudCompare": (
        shutil.which("CloudCompare") and shutil.which("xvfb-run"),
        cloud_compare,
        ["DXF faces", "DXF polyface", "STL", "STL text", "PLY", "OBJ", "OFF", "XYZ"],
    ),
    "PrusaSlicer": (shutil.which("prusa-slicer"), prusa, ["STL", "STL text", "OBJ", "3MF"]),
    "Blender": (
        shutil.which("blender"),
        blender,
        ["DXF faces", "DXF polyface", "DXF mesh", "STL", "STL text", "PLY", "OBJ", "GLB", "glTF"],
    ),
}


def write_open_mesh(path, side=30):
    """An open wavy sheet whose triangles are measured, displaced and synthesized in turn."""
    vertices = [(x / 7, y / 11, math.sin(x / 7) * math.cos(y / 11)) for y in range(side) for x in range(side)]
    corners = [y * side + x for y in range(side - 1) for x in range(side - 1)]
    triangles = [t for i in corners for t in ((i, i + 1, i + side), (i + 1, i + side + 1, i + side))]
    lines = [
        "ply",
        "format ascii 1.0",
        f"element vertex {len(vertices)}",
        *(f"property float {axis}" for axis in "xyz"),
        f"element face {len(triangles)}",
        "property list uchar int vertex_indices",
        "property uchar mark",
        "end_header",
    ]
    lines += ["%f %f %f" % vertex for vertex in vertices]
    lines += ["3 %d %d %d " % triangle + str(number % 3) for number, triangle in enumerate(triangles)]
    path.write_text("\n".join(lines) + "\n")


def compare(found, expected):
    return (
        "all"
        if found == expected
        else "nothing"
        if not found
        else found
        if isinstance(found, str)
        else f"{found} of {expected}"
    )


def main():
    page = PAGE.read_text()
    before, rest = page.split(BEGIN)
    old, after = rest.split(END)
    kept = {
        line.split("|")[1].strip(): line for line in old.splitlines() if line.startswith("| ") and "---" not in line
    }

    scan = Scans(PROGRAM).made("simulate", "bracket", "--rig", "digital", "--views", 2)
    program("edit", scan / "truth.ply", "--remesh", "4mm", "-o", WORK / "closed.ply")
    write_open_mesh(WORK / "open.ply")
    counts = {}
    for mesh in ("closed", "open"):
        counts[mesh] = program("edit", WORK / f"{mesh}.ply")
        (WORK / mesh).mkdir()
        for name, options in FORMATS.values():
            program("edit", WORK / f"{mesh}.ply", *options, "-o", WORK / mesh / name)

    rows = []
    for reader, (is_installed, count, columns) in READERS.items():
        if not is_installed or (ONLY and reader not in ONLY):
            if reader in kept:
                rows.append(kept[reader])
            continue
        cells = []
        for column, (name, _) in FORMATS.items():
            if column not in columns:
                cells.append("")
                continue
            element = "vertices" if column in ("XYZ", "PCD") else "triangles"
            results = {mesh: compare(count(WORK / mesh / name), counts[mesh][element]) for mesh in counts}
            same = len(set(results.values())) == 1
            cells.append(
                results["closed"] if same else ", ".join(f"{mesh}: {result}" for mesh, result in results.items())
            )
        rows.append(f"| {reader} | " + " | ".join(cells) + " |")
        print(rows[-1], flush=True)
    head = "| | " + " | ".join(FORMATS) + " |\n|" + "---|" * (len(FORMATS) + 1)
    PAGE.write_text(f"{before}{BEGIN}\n{head}\n" + "\n".join(rows) + f"\n{END}{after}")


main()
