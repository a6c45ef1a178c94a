"""Asks programs of others what they read of the files that the program writes, and renews the table
between the markers of docs/files.md: python3 tools/judge_files.py PROGRAM docs/files.md [JUDGE...]

A closed mesh goes out in every format; a cell says whether the other program finds all its triangles (all
its points, in clouds). What is not installed, or not among the judges named, is left
as it stands.
"""
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

PROGRAM = pathlib.Path(sys.argv[1]).resolve()
PAGE = pathlib.Path(sys.argv[2])
ONLY = set(sys.argv[3:])
HERE = pathlib.Path(__file__).resolve().parent.parent
WORK = pathlib.Path(tempfile.mkdtemp(prefix="frangia-judges-"))
BEGIN, END = "<!-- judges begin -->", "<!-- judges end -->"

FORMATS = {  # name of the column: file, options of edit
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
    """What a program says on both channels; empty when it takes longer than a quarter of an hour or fails to start."""
    try:
        answer = subprocess.run(list(map(str, command)), capture_output=True, text=True, timeout=900, errors="replace", cwd=WORK)
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


# Debian 12's importer of glTF asks NumPy for a name that it no longer has.
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


# MeshLab 2020.09 as Debian builds it ends on any OBJ, also on one of a single triangle: it is not asked.
JUDGES = {  # name: (is it here, how to ask, columns)
    "assimp": (shutil.which("assimp"), assimp, ["DXF faces", "DXF polyface", "STL", "STL text", "PLY", "OBJ", "GLB", "glTF", "3MF", "OFF"]),
    "ezdxf": (ask("/usr/bin/python3", "-c", "import ezdxf; print(1)").strip() == "1", script("judge_ezdxf.py"), ["DXF faces", "DXF polyface", "DXF mesh"]),
    "lib3mf": (ask("/usr/bin/python3", "-c", "import ctypes; ctypes.CDLL('lib3MF.so.1'); print(1)").strip() == "1", script("judge_3mf.py"), ["3MF"]),
    "admesh": (shutil.which("admesh"), lambda path: number(r"Number of facets\s+:\s+(\d+)", ask("admesh", "-e", path)), ["STL", "STL text"]),
    "NumPy": (True, python("numpy, sys", "print(len(numpy.loadtxt(sys.argv[1])))"), ["XYZ"]),
    "PCL": (ask("/usr/bin/python3", "-c", "import pcl; print(1)").strip() == "1", python("pcl, sys", "print(pcl.load(sys.argv[1]).size)"), ["PCD"]),
    "MeshLab": (shutil.which("meshlabserver") and shutil.which("xvfb-run"), meshlab, ["STL", "STL text", "PLY", "OFF", "XYZ"]),
    "CloudCompare": (shutil.which("CloudCompare") and shutil.which("xvfb-run"), cloud_compare, ["DXF faces", "DXF polyface", "STL", "STL text", "PLY", "OBJ", "OFF", "XYZ"]),
    "PrusaSlicer": (shutil.which("prusa-slicer"), prusa, ["STL", "STL text", "OBJ", "3MF"]),
    "Blender": (shutil.which("blender"), blender, ["DXF faces", "DXF polyface", "DXF mesh", "STL", "STL text", "PLY", "OBJ", "GLB", "glTF"]),
}


def main():
    page = PAGE.read_text()
    before, rest = page.split(BEGIN)
    old, after = rest.split(END)
    kept = {line.split("|")[1].strip(): line for line in old.splitlines() if line.startswith("| ") and "---" not in line}

    program("simulate", "bracket", "--rig", "digital", "--views", 2, "-o", WORK / "scan")
    source = WORK / "source.ply"
    program("edit", WORK / "scan" / "truth.ply", "--remesh", "4mm", "-o", source)
    truth = program("edit", source)
    for name, options in FORMATS.values():
        program("edit", source, *options, "-o", WORK / name)

    rows = []
    for judge, (is_here, question, columns) in JUDGES.items():
        if not is_here or (ONLY and judge not in ONLY):
            if judge in kept:
                rows.append(kept[judge])
            continue
        cells = []
        for column, (name, _) in FORMATS.items():
            wanted = truth["vertices"] if column in ("XYZ", "PCD") else truth["triangles"]
            found = question(WORK / name) if column in columns else None
            cells.append("" if column not in columns else "all" if found == wanted else "nothing" if not found else found if isinstance(found, str) else f"{found} of {wanted}")
        rows.append(f"| {judge} | " + " | ".join(cells) + " |")
        print(rows[-1], flush=True)
    head = "| | " + " | ".join(FORMATS) + " |\n|" + "---|" * (len(FORMATS) + 1)
    PAGE.write_text(f"{before}{BEGIN}\n{head}\n" + "\n".join(rows) + f"\n{END}{after}")


main()
