"""What a mesh file holds, as plain figures: read by other programs, by this one, and by NumPy, for tools/check_files.py.

Figures: triangles, area (mm2), volume (mm3), size (the sides of the bounding box in ascending order, since programs turn the
axes) and red (the share of vertices that are more red than blue; None where the reader knows no colours).
"""
import json
import pathlib
import re
import subprocess

import numpy

TYPES = {
    "char": "i1",
    "uchar": "u1",
    "short": "i2",
    "ushort": "u2",
    "int": "i4",
    "uint": "u4",
    "float": "f4",
    "double": "f8",
}


def ask(*command, folder=None, seconds=900):
    """Standard output and error of a program; empty when it cannot start or takes too long."""
    try:
        answer = subprocess.run(
            list(map(str, command)),
            capture_output=True,
            text=True,
            timeout=seconds,
            errors="replace",
            cwd=folder,
            stdin=subprocess.DEVNULL,
        )
    except (OSError, subprocess.TimeoutExpired):
        return ""
    return answer.stdout + answer.stderr


def of_triangles(corners, red=None):
    """The figures of an array of triangles, count x 3 corners x 3 coordinates."""
    if not len(corners):
        return None
    a, b, c = numpy.moveaxis(numpy.asarray(corners, float), 1, 0)
    cross = numpy.cross(b - a, c - a)
    points = corners.reshape(-1, 3)
    return {
        "triangles": len(corners),
        "area": float(numpy.linalg.norm(cross, axis=1).sum() / 2),
        "volume": float(numpy.einsum("ij,ij->", a, cross) / 6),
        "size": sorted(map(float, points.max(0) - points.min(0))),
        "red": red,
    }


def of_stl(path):
    """The figures of a binary STL."""
    if not path.exists():
        return None
    data = path.read_bytes()
    facet = numpy.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    count = int.from_bytes(data[80:84], "little")
    if len(data) < 84 + count * facet.itemsize:
        return None
    return of_triangles(numpy.frombuffer(data, facet, count, 84)["corners"])


def red_of_ply(path):
    """The share of red vertices of a PLY; None without colours."""
    if not path.exists():
        return None
    data = path.read_bytes()
    header, body = data.split(b"end_header\n", 1)
    lines = header.decode("latin1").split("element vertex ")[1].splitlines()
    properties = []
    for line in lines[1:]:
        if not line.startswith("property"):
            break
        properties.append((line.split()[2], "<" + TYPES[line.split()[1]]))
    if b"format ascii" in header:
        rows = numpy.loadtxt(body.decode().splitlines()[: int(lines[0])], ndmin=2)
        vertices = numpy.rec.fromarrays(rows.T, names=[name for name, _ in properties])
    else:
        vertices = numpy.frombuffer(body, numpy.dtype(properties), int(lines[0]))
    return float((vertices["red"] > vertices["blue"]).mean()) if "red" in vertices.dtype.names else None


def by_frangia(program, path):
    """What this program reads; None where it refuses the file."""
    text = ask(program, "--json", "edit", path, "-o", path.with_name(path.name + ".read.ply"))
    answer = json.JSONDecoder().raw_decode(text)[0] if text.startswith("{") else {}
    if "triangles" not in answer:
        return None
    size = sorted(high - low for low, high in zip(answer["min_mm"], answer["max_mm"]))
    return {
        "triangles": answer["triangles"],
        "area": answer["area_mm2"],
        "volume": answer.get("volume_mm3"),
        "size": size,
        "red": red_of_ply(path.with_name(path.name + ".read.ply")),
    }


def converted_by(convert):
    """Reads by the binary STL that a program makes of a file, and by its PLY for colours."""

    def read(path):
        stl, ply = path.with_name(path.name + ".out.stl"), path.with_name(path.name + ".out.ply")
        convert(path, stl)
        found = of_stl(stl)
        if found:
            convert(path, ply)
            try:
                found["red"] = red_of_ply(ply)
            except (ValueError, IndexError, KeyError):
                found["red"] = None
        return found

    return read


def assimp_convert(path, out):
    ask("assimp", "export", path, out, "-f" + {".stl": "stlb", ".ply": "ply"}[out.suffix], folder=path.parent)


def meshlab_convert(path, out):
    colors = ["-m", "vc"] if out.suffix == ".ply" else []
    ask("xvfb-run", "-a", "meshlabserver", "-i", path, "-o", out, *colors, folder=path.parent)


# The glTF importer of Debian 12 uses numpy.bool, which its NumPy no longer has.
BLENDER = """
import bpy, bmesh, json, numpy, sys
numpy.bool = bool
path, *outputs = sys.argv[sys.argv.index('--') + 1:]
bpy.ops.wm.read_factory_settings(use_empty=True)
for addon in ('io_import_dxf', 'io_export_dxf'):
    bpy.ops.preferences.addon_enable(module=addon)
ops = bpy.ops
read = {'stl': ops.import_mesh.stl, 'ply': ops.import_mesh.ply, 'obj': ops.wm.obj_import, 'glb': ops.import_scene.gltf,
        'gltf': ops.import_scene.gltf, 'dxf': ops.import_scene.dxf}
read[path.rsplit('.', 1)[1]](filepath=path)
meshes = [o for o in bpy.data.objects if o.type == 'MESH']
count, area, volume, points, colors = 0, 0.0, 0.0, [], []
for o in meshes:
    work = bmesh.new()
    work.from_mesh(o.data)
    work.transform(o.matrix_world)
    bmesh.ops.triangulate(work, faces=work.faces)
    count, area, volume = count + len(work.faces), area + sum(f.calc_area() for f in work.faces), volume + work.calc_volume(signed=True)
    points += [tuple(v.co) for v in work.verts]
    for layer in list(o.data.color_attributes)[:1]:
        colors += [tuple(d.color) for d in layer.data]
size = sorted(max(p[i] for p in points) - min(p[i] for p in points) for i in range(3)) if points else [0, 0, 0]
red = sum(c[0] > c[2] for c in colors) / len(colors) if colors else None
print('FIGURES', json.dumps(dict(triangles=count, area=area, volume=volume, size=size, red=red)))
write = {'stl': ops.export_mesh.stl, 'ply': ops.export_mesh.ply, 'obj': ops.wm.obj_export, 'dxf': ops.export.dxf,
         'glb': lambda filepath: ops.export_scene.gltf(filepath=filepath, export_format='GLB'),
         'gltf': lambda filepath: ops.export_scene.gltf(filepath=filepath, export_format='GLTF_EMBEDDED')}
for output in outputs:
    try:
        write[output.rsplit('.', 1)[1]](filepath=output)
    except Exception as fault:
        print('CANNOT', output, fault)
"""

FREECAD = """
import json, os, Mesh
path, outputs = os.environ['CHECK_PATH'], os.environ['CHECK_OUTPUTS'].split()
m = Mesh.Mesh(path)
b = m.BoundBox
print('FIGURES', json.dumps(dict(triangles=m.CountFacets, area=m.Area, volume=m.Volume, size=sorted([b.XLength, b.YLength, b.ZLength]), red=None)))
for output in outputs:
    try:
        m.write(output)
    except Exception as fault:
        print('CANNOT', output, fault)
"""


def figures_in(text):
    found = re.search(r"FIGURES (\{.*\})", text)
    figures = json.loads(found[1]) if found else {}
    return figures if figures.get("triangles") else None


def by_blender(path, *outputs):
    return figures_in(ask("blender", "-b", "--python-expr", BLENDER, "--", path, *outputs, folder=path.parent))


def by_freecad(path, *outputs):
    variables = [f"CHECK_PATH={path}", "CHECK_OUTPUTS=" + " ".join(map(str, outputs))]
    return figures_in(ask("env", *variables, "freecadcmd", "-c", FREECAD, folder=path.parent, seconds=300))


by_assimp = converted_by(assimp_convert)
by_meshlab = converted_by(meshlab_convert)


def write_part(path, sides=(30, 20, 10), step=2.5):
    """A box as a text PLY with shared vertices, red where x is below the middle, else blue. Returns its figures."""
    numbers, triangles = {}, []

    def number_of(point):
        return numbers.setdefault(tuple(point), len(numbers))

    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for end in (0, sides[axis]):
            for i in range(int(sides[u] / step)):
                for j in range(int(sides[v] / step)):
                    corners = []
                    for du, dv in ((0, 0), (1, 0), (1, 1), (0, 1)):
                        point = [0.0] * 3
                        point[axis], point[u], point[v] = end, (i + du) * step, (j + dv) * step
                        corners.append(number_of(point))
                    corners = corners if end else corners[::-1]
                    triangles += [corners[:3], [corners[0], corners[2], corners[3]]]
    colors = ["255 0 0" if point[0] < sides[0] / 2 else "0 0 255" for point in numbers]
    lines = ["ply", "format ascii 1.0", f"element vertex {len(numbers)}"]
    lines += [f"property float {axis}" for axis in "xyz"] + [f"property uchar {c}" for c in ("red", "green", "blue")]
    lines += [f"element face {len(triangles)}", "property list uchar int vertex_indices", "end_header"]
    lines += ["%g %g %g " % point + color for point, color in zip(numbers, colors)]
    lines += ["3 %d %d %d" % tuple(triangle) for triangle in triangles]
    pathlib.Path(path).write_text("\n".join(lines) + "\n")
    a, b, c = sides
    return {
        "triangles": len(triangles),
        "area": 2.0 * (a * b + b * c + c * a),
        "volume": float(a * b * c),
        "size": sorted(map(float, sides)),
        "red": sum(color == "255 0 0" for color in colors) / len(colors),
    }


def difference(found, right, with_colors, scale=1.0):
    """What differs from the right figures, in words; empty where nothing does. Lengths are `scale` times the right ones."""
    if not found:
        return "not read"
    faults = []
    if found["triangles"] != right["triangles"]:
        faults.append(f"{found['triangles']} of {right['triangles']} triangles")
    for name, power in (("area", 2), ("volume", 3)):
        wanted = right[name] * scale**power
        if found[name] is None or abs(found[name] - wanted) > 1e-4 * wanted:
            faults.append(f"{name} {found[name]} for {wanted:g}")
    if any(abs(one - other * scale) > 1e-4 * other * scale for one, other in zip(found["size"], right["size"])):
        faults.append("size " + " x ".join(f"{side:.6g}" for side in found["size"]))
    if with_colors and (found["red"] is None or abs(found["red"] - right["red"]) > 0.1):
        faults.append("no colours" if found["red"] is None else f"{found['red']:.2f} red for {right['red']:.2f}")
    return ", ".join(faults)
