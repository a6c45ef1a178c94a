"""Exchanges files with other programs and updates the tables of docs/files.md: python3 tools/check_files.py PROGRAM docs/files.md [READER...]

First table: a closed coloured box, whose figures are known, and an open mesh with marks are written in every format, and other
programs read them: those of FIGURES state triangles, area, volume, size and colours, the others count. Second table: four other
programs write the box in their formats, and this one reads it. Rows of programs that are not installed, or not among those named,
stay as they are.
"""
import json
import math
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parent))

import measured_files as files  # noqa: E402
from measured_files import ask, difference  # noqa: E402

PROGRAM = pathlib.Path(sys.argv[1]).resolve()
PAGE = pathlib.Path(sys.argv[2])
ONLY = set(sys.argv[3:])
HERE = pathlib.Path(__file__).resolve().parent.parent
WORK = pathlib.Path(tempfile.mkdtemp(prefix="frangia-check-files-"))
READERS_AT = "<!-- readers begin -->", "<!-- readers end -->"
WRITERS_AT = "<!-- writers begin -->", "<!-- writers end -->"

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


def number(pattern, text):
    found = re.search(pattern, text)
    return int(found.group(1)) if found else None


def python(module, script):
    return lambda path: number(r"(?m)^(\d+)", ask("/usr/bin/python3", "-c", f"import {module}\n{script}", path))


def script(name):
    return lambda path: number(r"(?m)^(\d+)", ask("/usr/bin/python3", HERE / "tests" / "files" / name, path))


def cloud_compare(path):
    text = ask("xvfb-run", "-a", "CloudCompare", "-SILENT", "-O", path)
    points = number(r"Found one cloud with (\d+) points", text)
    if points and path.suffix != ".xyz":
        return "points alone"
    return points or number(r"Found one mesh with (\d+) faces", text)


def prusa(path):
    return number(r"number_of_facets\s*=\s*(\d+)", ask("prusa-slicer", "--info", path))


# MeshLab 2020.09 of Debian 12 crashes on any OBJ, even of one triangle, so OBJ is not among its columns.
FIGURES = {  # name: (is it installed, how to read figures, columns, those with colours)
    "assimp": (
        shutil.which("assimp"),
        files.by_assimp,
        ["DXF faces", "DXF polyface", "STL", "STL text", "PLY", "OBJ", "GLB", "glTF", "3MF", "OFF"],
        ["PLY", "OBJ", "GLB", "glTF"],
    ),
    "MeshLab": (
        shutil.which("meshlabserver") and shutil.which("xvfb-run"),
        files.by_meshlab,
        ["STL", "STL text", "PLY", "OFF"],
        ["PLY"],
    ),
    "FreeCAD": (shutil.which("freecadcmd"), files.by_freecad, ["STL", "STL text", "PLY", "OBJ", "OFF"], []),
    "Blender": (
        shutil.which("blender"),
        files.by_blender,
        ["DXF faces", "DXF polyface", "DXF mesh", "STL", "STL text", "PLY", "OBJ", "GLB", "glTF"],
        ["PLY", "OBJ", "GLB", "glTF"],
    ),
}

READERS = {  # name: (is it installed, how to count, columns)
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
    "CloudCompare": (
        shutil.which("CloudCompare") and shutil.which("xvfb-run"),
        cloud_compare,
        ["DXF faces", "DXF polyface", "STL", "STL text", "PLY", "OBJ", "OFF", "XYZ"],
    ),
    "PrusaSlicer": (shutil.which("prusa-slicer"), prusa, ["STL", "STL text", "OBJ", "3MF"]),
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


def in_metres(column):
    return column in ("GLB", "glTF")


def read_by_others(counts, right, kept):
    """The rows of the first table."""
    names = [*FIGURES, *READERS]
    rows = []
    for reader in names:
        is_installed = (FIGURES.get(reader) or READERS[reader])[0]
        if not is_installed or (ONLY and reader not in ONLY):
            rows += [kept[reader]] if reader in kept else []
            continue
        cells = []
        for column, (name, _) in FORMATS.items():
            columns = (FIGURES.get(reader) or READERS[reader])[2]
            if column not in columns:
                cells.append("")
                continue
            element = "vertices" if column in ("XYZ", "PCD") else "triangles"
            if reader in FIGURES:
                read, with_colors = FIGURES[reader][1], column in FIGURES[reader][3]
                scale = 0.001 if in_metres(column) else 1.0
                closed = difference(read(WORK / "closed" / name), right, with_colors, scale) or "all"
                found = read(WORK / "open" / name)
                results = {
                    "closed": closed,
                    "open": compare(found and found["triangles"], counts["open"]["triangles"]),
                }
            else:
                count = READERS[reader][1]
                results = {mesh: compare(count(WORK / mesh / name), counts[mesh][element]) for mesh in counts}
            same = len(set(results.values())) == 1
            cells.append(
                results["closed"] if same else ", ".join(f"{mesh}: {result}" for mesh, result in results.items())
            )
        rows.append(f"| {reader} | " + " | ".join(cells) + " |")
        print(rows[-1], flush=True)
    return rows


def written_by_assimp(folder):
    kinds = {
        "STL": "stlb",
        "STL text": "stl",
        "PLY": "plyb",
        "PLY text": "ply",
        "OBJ": "obj",
        "GLB": "glb2",
        "glTF": "gltf2",
        "3MF": "3mf",
    }
    for column, kind in kinds.items():
        ask("assimp", "export", WORK / "closed.ply", folder / WRITTEN[column], "-f" + kind, folder=folder)


def written_by_meshlab(folder):
    for column in ("STL", "PLY", "OBJ", "OFF", "DXF"):
        out = folder / WRITTEN[column]
        ask("xvfb-run", "-a", "meshlabserver", "-i", WORK / "closed.ply", "-o", out, "-m", "vc", folder=folder)


def written_by_freecad(folder):
    files.by_freecad(WORK / "closed.ply", *(folder / WRITTEN[column] for column in ("STL", "PLY", "OBJ", "OFF", "3MF")))


def written_by_blender(folder):
    columns = ("STL", "PLY", "OBJ", "GLB", "glTF", "DXF")
    files.by_blender(WORK / "closed.ply", *(folder / WRITTEN[column] for column in columns))


WRITTEN = {
    "STL": "part.stl",
    "STL text": "text.stl",
    "PLY": "part.ply",
    "PLY text": "text.ply",
    "OBJ": "part.obj",
    "OFF": "part.off",
    "GLB": "part.glb",
    "glTF": "part.gltf",
    "3MF": "part.3mf",
    "DXF": "part.dxf",
}
WRITERS = {
    "assimp": (written_by_assimp, ["PLY text", "OBJ", "GLB", "glTF"]),
    "MeshLab": (written_by_meshlab, ["PLY", "OFF"]),
    "FreeCAD": (written_by_freecad, []),
    "Blender": (written_by_blender, ["PLY"]),
}


def written_by_others(right, kept):
    """The rows of the second table. A cell is empty where the program writes no such file."""
    rows = []
    for writer, (write, with_colors) in WRITERS.items():
        if not FIGURES[writer][0] or (ONLY and writer not in ONLY):
            rows += [kept[writer]] if writer in kept else []
            continue
        folder = WORK / f"by-{writer}"
        folder.mkdir()
        write(folder)
        cells = []
        for column, name in WRITTEN.items():
            if not (folder / name).exists():
                cells.append("")
                continue
            scale = 1000.0 if in_metres(column) else 1.0
            found = files.by_frangia(PROGRAM, folder / name)
            cells.append(difference(found, right, column in with_colors, scale) or "all")
        rows.append(f"| {writer} | " + " | ".join(cells) + " |")
        print(rows[-1], flush=True)
    return rows


def replace_table(page, marks, columns, rows_of):
    """The page with new rows between two marks; `rows_of` gets those that stand there, by name."""
    before, rest = page.split(marks[0])
    old, after = rest.split(marks[1])
    kept = {
        line.split("|")[1].strip(): line for line in old.splitlines() if line.startswith("| ") and "---" not in line
    }
    head = "| | " + " | ".join(columns) + " |\n|" + "---|" * (len(columns) + 1)
    return f"{before}{marks[0]}\n{head}\n" + "\n".join(rows_of(kept)) + f"\n{marks[1]}{after}"


def main():
    right = files.write_part(WORK / "closed.ply")
    write_open_mesh(WORK / "open.ply")
    counts = {}
    for mesh in ("closed", "open"):
        counts[mesh] = program("edit", WORK / f"{mesh}.ply")
        (WORK / mesh).mkdir()
        for name, options in FORMATS.values():
            program("edit", WORK / f"{mesh}.ply", *options, "-o", WORK / mesh / name)
    page = PAGE.read_text()
    page = replace_table(page, READERS_AT, FORMATS, lambda kept: read_by_others(counts, right, kept))
    page = replace_table(page, WRITERS_AT, WRITTEN, lambda kept: written_by_others(right, kept))
    PAGE.write_text(page)


main()
