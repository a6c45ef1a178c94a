"""The same box of 30 x 20 x 10 in about 100 files, each written as some program writes its format: quirks_test.py PROGRAM

Every file is read with 12 triangles, 2200 mm2 and 6000 mm3 (points: 8), or refused in a sentence where REFUSED says so. The files
are written here byte by byte, without code of the readers.
"""
import base64
import json
import pathlib
import struct
import subprocess
import sys
import tempfile

PROGRAM = pathlib.Path(sys.argv[1]).resolve()
VERTICES = [(x, y, z) for z in (0, 10.0) for y in (0, 20.0) for x in (0, 30.0)]
QUADS = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
TRIANGLES = [t for q in QUADS for t in ((q[0], q[1], q[2]), (q[0], q[2], q[3]))]
LETTERS = {"char": "b", "uchar": "B", "short": "h", "ushort": "H", "int": "i", "uint": "I", "float": "f", "double": "d"}
LETTERS |= {
    "int8": "b",
    "uint8": "B",
    "int16": "h",
    "uint16": "H",
    "int32": "i",
    "uint32": "I",
    "float32": "f",
    "float64": "d",
}
REFUSED = {  # file: a part of the sentence
    "cr.ply": "not a keyword of a PLY header",
    "bom.ply": "does not begin with the word ply",
    "no-endsolid.stl": "may be truncated",
    "nul.stl": "truncated or not an STL file",
    "upper.obj": "it has no vertex",
    "no-header.off": "expected 'OFF'",
    "lower.off": "expected 'OFF'",
    "commas.xyz": "is not a number",
    "semicolons.xyz": "is not a number",
    "count.xyz": "a point needs three",
    "names.xyz": "is not a number",
}


def ply(
    form="ascii",
    vertex="float",
    count="uchar",
    index="int",
    name="vertex_indices",
    end="\n",
    remark="",
    faces=QUADS,
    extra="",
    face="",
    values="",
):
    """A PLY; `extra` is a further property of vertices, `face` and `values` of faces (text only)."""
    header = ["ply", f"format {form} 1.0", *filter(None, [remark]), f"element vertex {len(VERTICES)}"]
    header += [f"property {vertex} {axis}" for axis in "xyz"] + [f"property {extra}"] * bool(extra)
    header += [
        f"element face {len(faces)}",
        f"property list {count} {index} {name}",
        *filter(None, [face]),
        "end_header",
    ]
    if form == "ascii":
        lines = [" ".join(map(str, v)) + " 7" * bool(extra) for v in VERTICES]
        lines += [f"{len(f)} " + " ".join(map(str, f)) + values for f in faces]
        return end.join([*header, *lines, ""]).encode()
    order = "<" if "little" in form else ">"
    data = end.join([*header, ""]).encode()
    for v in VERTICES:
        data += struct.pack(order + "3" + LETTERS[vertex], *v)
        data += struct.pack(order + LETTERS[extra.split()[0]], 7) if extra else b""
    for f in faces:
        data += struct.pack(order + LETTERS[count], len(f)) + struct.pack(f"{order}{len(f)}{LETTERS[index]}", *f)
    return data


def ply_files():
    for form in ("ascii", "binary_little_endian", "binary_big_endian"):
        for types in ("float int", "double uint", "float32 ushort", "float64 uint16", "double int32"):
            vertex, index = types.split()
            yield f"{form}-{vertex}-{index}.ply", ply(form, vertex, index=index, faces=TRIANGLES)
        for count in ("uint8", "int", "ushort"):
            yield f"{form}-count-{count}.ply", ply(form, count=count)
        yield f"{form}-vertex-index.ply", ply(form, name="vertex_index")
        yield f"{form}-extra.ply", ply(form, extra="int label")
        yield f"{form}-crlf.ply", ply(form, end="\r\n")
    yield "remarks.ply", ply(remark="comment made by hand\ncomment TextureFile a.png\nobj_info num_cols 5")
    yield "face-colors.ply", ply(
        face="property uchar red\nproperty uchar green\nproperty uchar blue", values=" 255 0 0"
    )
    yield "texture.ply", ply(face="property list uchar float texcoord", values=" 6 0 0 1 0 1 1")
    yield "short-index.ply", ply("binary_little_endian", index="short")
    yield "cr.ply", ply(end="\r")
    yield "bom.ply", b"\xef\xbb\xbf" + ply()


def stl(name=" part", number="{:g}", normal="0 0 0", solids=1, indent="  "):
    lines = []
    share = len(TRIANGLES) // solids
    for begin in range(0, len(TRIANGLES), share):
        lines.append("solid" + name)
        for triangle in TRIANGLES[begin : begin + share]:
            lines += [f"{indent}facet normal {normal}", f"{2 * indent}outer loop"]
            lines += [3 * indent + "vertex " + " ".join(map(number.format, VERTICES[i])) for i in triangle]
            lines += [f"{2 * indent}endloop", f"{indent}endfacet"]
        lines.append("endsolid" + name)
    return "\n".join([*lines, ""]).encode()


def stl_files():
    for name, header in {"plain": b"x", "solid": b"solid of something", "color": b"COLOR=\xff\x00\x00\xff"}.items():
        facets = [struct.pack("<12fH", 0, 0, 0, *(c for i in t for c in VERTICES[i]), 0) for t in TRIANGLES]
        yield f"binary-{name}.stl", header.ljust(80) + struct.pack("<I", len(facets)) + b"".join(facets)
    text = stl()
    yield "text.stl", text
    yield "crlf.stl", text.replace(b"\n", b"\r\n")
    yield "cr.stl", text.replace(b"\n", b"\r")
    yield "upper.stl", text.upper()
    yield "bom.stl", b"\xef\xbb\xbf" + text
    yield "leading-blanks.stl", b"\n\n  " + text
    yield "other-end.stl", text.replace(b"endsolid part", b"endsolid other name")
    yield "no-name.stl", stl(name="")
    yield "odd-name.stl", stl(name=' teil, gr\u00f6\u00dfe "5"')
    yield "long-name.stl", stl(name=" " + 300 * "x")
    yield "tabs.stl", stl(indent="\t")
    yield "exponents.stl", stl(number="{:.6E}")
    yield "three-solids.stl", stl(solids=3)
    yield "nan-normals.stl", stl(normal="nan nan nan")
    yield "no-endsolid.stl", text.rsplit(b"endsolid", 1)[0]
    yield "nul.stl", text + b"\0\0"


def obj_files():
    def vertices(form="v {:g} {:g} {:g}\n"):
        return "".join(form.format(*v) for v in VERTICES)

    def faces(form="{0}", of=QUADS):
        return "".join("f " + " ".join(form.format(i + 1) for i in face) + "\n" for face in of)

    plain = vertices() + faces()
    yield "triangles.obj", vertices() + faces(of=TRIANGLES)
    yield "quads.obj", plain
    yield "texture.obj", vertices() + "vt 0 0\n" * 8 + faces("{0}/{0}")
    yield "normals.obj", vertices() + "vn 0 0 1\n" * 8 + faces("{0}//{0}")
    yield "both.obj", vertices() + "vt 0 0\n" * 8 + "vn 0 0 1\n" * 8 + faces("{0}/{0}/{0}")
    yield "negative.obj", vertices() + "".join("f " + " ".join(str(i - 8) for i in q) + "\n" for q in QUADS)
    yield "groups.obj", "mtllib a.mtl\no box\n" + vertices() + "g a b\nusemtl x\ns 1\n" + faces() + "s off\n"
    yield "tabs.obj", plain.replace(" ", "\t")
    yield "blanks.obj", plain.replace(" ", "  ").replace("\n", " \n")
    yield "cr.obj", plain.replace("\n", "\r")
    yield "crlf.obj", plain.replace("\n", "\r\n")
    yield "bom.obj", "\ufeff" + plain
    yield "utf16.obj", plain.encode("utf-16")
    yield "no-end.obj", plain.rstrip()
    yield "exponents.obj", vertices("v {:.3e} {:.3E} {:.2e}\n") + faces()
    yield "plus.obj", vertices("v +{:g} +{:g} +{:g}\n") + faces()
    yield "weights.obj", vertices("v {:g} {:g} {:g} 1.0\n") + faces()
    yield "lines.obj", plain + "vp 0.1 0.2\nl 1 2 3\np 1\n"
    yield "faces-first.obj", faces() + vertices()
    yield "upper.obj", plain.upper()


def off_files():
    def off(header="OFF\n", vertex="", face=""):
        points = "".join("{:g} {:g} {:g}{}\n".format(*v, vertex) for v in VERTICES)
        return f"{header}8 6 0\n" + points + "".join("4 " + " ".join(map(str, q)) + face + "\n" for q in QUADS)

    yield "plain.off", off()
    yield "one-line.off", off("OFF ")
    yield "colors.off", off("COFF\n", vertex=" 255 0 0 255")
    yield "normals.off", off("NOFF\n", vertex=" 0 0 1")
    yield "texture.off", off("STOFF\n", vertex=" 0 0")
    yield "face-colors.off", off(face=" 255 0 0")
    yield "remarks.off", off("OFF\n# made by hand\n\n")
    yield "bom.off", "\ufeff" + off()
    yield "crlf.off", off().replace("\n", "\r\n")
    yield "no-header.off", off("")
    yield "lower.off", off("off\n")


def gltf(index="H", points=VERTICES, corners=None, node=None):
    """The box in metres; without `index`, three points make a triangle."""
    positions = b"".join(struct.pack("<3f", *(c / 1000 for c in p)) for p in points)
    corners = [i for t in TRIANGLES for i in t] if index else [0]
    indices = struct.pack(f"<{len(corners)}{index or 'B'}", *corners)
    primitive = {"attributes": {"POSITION": 0}, **({"indices": 1} if index else {})}
    kind = {"B": 5121, "H": 5123, "I": 5125, None: 5121}[index]
    data = base64.b64encode(positions + indices).decode()
    return json.dumps(
        {
            "asset": {"version": "2.0"},
            "scenes": [{"nodes": [0]}],
            "nodes": [{"mesh": 0, **(node or {})}],
            "meshes": [{"primitives": [primitive]}],
            "accessors": [
                {"bufferView": 0, "componentType": 5126, "count": len(points), "type": "VEC3"},
                {"bufferView": 1, "componentType": kind, "count": len(corners), "type": "SCALAR"},
            ],
            "bufferViews": [
                {"buffer": 0, "byteLength": len(positions)},
                {"buffer": 0, "byteOffset": len(positions), "byteLength": len(indices)},
            ],
            "buffers": [
                {"byteLength": len(positions + indices), "uri": f"data:application/octet-stream;base64,{data}"}
            ],
        }
    )


def gltf_files():
    for index in "BHI":
        yield f"index-{index}.gltf", gltf(index)
    yield "no-index.gltf", gltf(None, [VERTICES[i] for t in TRIANGLES for i in t])
    yield "moved.gltf", gltf(node={"scale": [1, 1, 1], "translation": [1, 2, 3]})
    yield "turned.gltf", gltf(node={"rotation": [0, 0, 0.70710678, 0.70710678]})
    yield "matrix.gltf", gltf(node={"matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 5, 5, 1]})
    yield "mirrored.gltf", gltf(node={"scale": [-1, 1, 1]})


def xyz_files():
    def lines(separator=" ", after=""):
        return "".join(separator.join(f"{c:g}" for c in v) + after + "\n" for v in VERTICES)

    yield "plain.xyz", lines()
    yield "tabs.xyz", lines("\t")
    yield "remarks.xyz", "# x y z\n// points\n" + lines()
    yield "intensity.xyz", lines(after=" 200")
    yield "colors.xyz", lines(after=" 255 0 0")
    yield "commas.xyz", lines(",")
    yield "semicolons.xyz", lines(";")
    yield "count.xyz", "8\npoints\n" + lines()
    yield "names.xyz", "X Y Z\n" + lines()


def fault_of(name, folder):
    """What is wrong with how a file is read; empty where nothing is."""
    command = [PROGRAM, "--json", "edit", name] + (["-o", "out.ply"] if name.endswith(".xyz") else [])
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    answer = json.loads(done.stdout)
    message = answer.get("error", {}).get("message", "")
    if name in REFUSED:
        return "" if REFUSED[name] in message and done.returncode == 3 else f"it is not refused: {message or answer}"
    if message:
        return message
    if name.endswith(".xyz"):
        return "" if answer["vertices"] == 8 else f"{answer['vertices']} points"
    area, volume = answer["area_mm2"], answer.get("volume_mm3") or 0.0
    right = answer["triangles"] == 12 and abs(area - 2200) < 0.01 and abs(volume - 6000) < 0.1
    return "" if right else f"{answer['triangles']} triangles, {area} mm2, {volume} mm3"


def main():
    faults, names = [], set()
    with tempfile.TemporaryDirectory() as folder:
        for files in (ply_files, stl_files, obj_files, off_files, gltf_files, xyz_files):
            for name, data in files():
                pathlib.Path(folder, name).write_bytes(data if isinstance(data, bytes) else data.encode())
                names.add(name)
                fault = fault_of(name, folder)
                if fault:
                    faults.append(f"{name}: {fault}")
    faults += [f"{name}: it was not tried" for name in sorted(REFUSED.keys() - names)]
    print("\n".join(faults) or f"{len(names)} files are read or refused as they should be")
    sys.exit(1 if faults else 0)


main()
