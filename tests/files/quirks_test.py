"""The same box of 30 x 20 x 10 in PLY, STL, OBJ and OFF, each as some program writes it: quirks_test.py PROGRAM

Every file is read with 12 triangles, 2200 mm2 and 6000 mm3, with a warning or refused in a sentence where that is stated. The
files are written here byte by byte, without code of the readers.
"""
import gzip
import pathlib
import struct
import sys

from quirks import BOX, QUADS, TRIANGLES, VERTICES, colored, faults_of, refused, warned

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
SOUP = [VERTICES[i] for t in TRIANGLES for i in t]
SOUP_FACES = [tuple(range(3 * i, 3 * i + 3)) for i in range(12)]
JOINED = warned("vertices were joined to 8")
RGB = (200, 100, 50)


def ply(
    form="ascii",
    vertex="float",
    count="uchar",
    index="int",
    name="vertex_indices",
    end="\n",
    remark="",
    faces=QUADS,
    extra=(),
    of=(7,),
    face="",
    values="",
    vertices=VERTICES,
):
    """A PLY; `extra` are further properties of vertices with the values `of`, `face` and `values` of faces (text only)."""
    header = ["ply", f"format {form} 1.0", *filter(None, [remark]), f"element vertex {len(vertices)}"]
    header += [f"property {vertex} {axis}" for axis in "xyz"] + [f"property {word}" for word in extra]
    header += [
        f"element face {len(faces)}",
        f"property list {count} {index} {name}",
        *filter(None, [face]),
        "end_header",
    ]
    if form == "ascii":
        further = [str(value) for value in of[: len(extra)]]
        lines = [" ".join([f"{c:g}" for c in v] + further) for v in vertices]
        lines += [f"{len(f)} " + " ".join(map(str, f)) + values for f in faces]
        return end.join([*header, *lines, ""]).encode()
    order = "<" if "little" in form else ">"
    data = end.join([*header, ""]).encode()
    whole = LETTERS[vertex] not in "fd"
    for v in vertices:
        data += struct.pack(order + "3" + LETTERS[vertex], *(int(c) if whole else c for c in v))
        for word, value in zip(extra, of):
            data += struct.pack(order + LETTERS[word.split()[0]], value)
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
        yield f"{form}-extra.ply", ply(form, extra=["int label"])
        yield f"{form}-crlf.ply", ply(form, end="\r\n")
        yield f"{form}-cr.ply", ply(form, end="\r")
        for count, index in [("char", "char"), ("float", "float"), ("double", "double"), ("uint", "short")]:
            yield f"{form}-list-{count}-{index}.ply", ply(form, count=count, index=index)
        for vertex in ("int", "short", "uchar"):
            yield f"{form}-of-{vertex}.ply", ply(form, vertex)
        yield f"{form}-soup.ply", ply(form, vertices=SOUP, faces=SOUP_FACES), JOINED
        for kind, names, of in [
            ("uchar", "diffuse_red diffuse_green diffuse_blue", RGB),
            ("uchar", "r g b", RGB),
            ("int", "red green blue", RGB),
            ("float", "red green blue", (200.0, 100.0, 50.0)),
            ("float", "red green blue", (200 / 255, 100 / 255, 50 / 255)),
            ("double", "Red Green Blue", (200 / 255, 100 / 255, 50 / 255)),
            ("ushort", "red green blue", (51400, 25700, 12850)),
        ]:
            extra = [f"{kind} {name}" for name in names.split()]
            yield f"{form}-{kind}-{names.split()[0]}-{of[0]:.0f}.ply", ply(form, extra=extra, of=of), colored(RGB)
        # bytes after the faces that the header counts are reported
        rest = b"3 0 1 2\n" if form == "ascii" else b"\x03\x00\x00\x01\x00\x02\x00"
        yield f"{form}-behind.ply", ply(form) + rest, warned("left out behind what its header counts")
        yield f"{form}-blank-behind.ply", ply(form) + b"\r\n \n", BOX
    yield "fewer-faces.ply", ply().replace(b"element face 6", b"element face 5"), {
        **warned("bytes are left out behind what its header counts", {"triangles": 10})
    }
    yield "remarks.ply", ply(remark="comment made by hand\ncomment TextureFile a.png\nobj_info num_cols 5")
    yield "face-colors.ply", ply(
        face="property uchar red\nproperty uchar green\nproperty uchar blue", values=" 255 0 0"
    )
    yield "texture.ply", ply(face="property list uchar float texcoord", values=" 6 0 0 1 0 1 1")
    yield "short-index.ply", ply("binary_little_endian", index="short")
    yield "bom.ply", b"\xef\xbb\xbf" + ply()
    yield "utf16.ply", ply().decode().encode("utf-16")
    yield "capitals.ply", ply().replace(b"float x", b"float X")
    yield "remark-behind.ply", ply().replace(b"element face", b"Scanned in Munich\nelement face")
    yield "misspelt.ply", ply().replace(b"property float z", b"propety float z"), refused("'propety' is not a keyword")
    yield "gzip.ply", gzip.compress(ply()), refused("unpack it with gunzip")
    grid = "obj_info num_cols 2\nobj_info num_rows 2\nelement vertex 4\nproperty double x\nproperty double y\n"
    grid = f"ply\nformat ascii 1.0\n{grid}property double z\nelement range_grid 4\nproperty list uchar int vertex_indices\n"
    cells = "".join(f"{x} {y} 0.25\n" for y in (0.5, 3) for x in (0.25, 4.25)) + "1 0\n1 1\n1 2\n1 3\n"
    yield "range-grid.ply", f"{grid}end_header\n{cells}", {"triangles": 2, "area": 10.0}


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


def binary_stl(header=b"x", stated=None, of=TRIANGLES, behind=b""):
    facets = [struct.pack("<12fH", 0, 0, 0, *(c for i in t for c in VERTICES[i]), 0) for t in of]
    return header.ljust(80) + struct.pack("<I", len(of) if stated is None else stated) + b"".join(facets) + behind


def stl_files():
    for name, header in {"plain": b"x", "solid": b"solid of something", "color": b"COLOR=\xff\x00\x00\xff"}.items():
        yield f"binary-{name}.stl", binary_stl(header)
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
    yield "no-endsolid.stl", text.rsplit(b"endsolid", 1)[0], refused("may be truncated")
    yield "nul.stl", text + b"\0\0"
    yield "ctrl-z.stl", text + b"\x1a"
    yield "cr-and-lf.stl", text.replace(b"\n", b"\r") + b"\n"
    yield "end-loop.stl", text.replace(b"endloop", b"end loop").replace(b"endsolid", b"end solid")
    yield "utf16.stl", text.decode().encode("utf-16")
    yield "utf16-big.stl", b"\xfe\xff" + text.decode().encode("utf-16-be")
    yield "fortran.stl", stl(number="{:.3E}").replace(b"E+", b"D+")
    yield "empty-solid.stl", b"solid none\nendsolid none\n" + text
    behind = warned("left out behind its last facet")
    for count in (1, 2, 49, 100, 176, 3001):
        yield f"behind-{count}.stl", binary_stl(behind=b"M" * count), behind
    yield "padding.stl", binary_stl(behind=b"\0" * 50), behind
    yield "more-facets.stl", binary_stl(stated=11), refused("its header states 11 facets, but 1 more follow")
    yield "count-0.stl", binary_stl(stated=0), warned("states no number of facets")
    yield "count-minus-1.stl", binary_stl(b"solid x", stated=2**32 - 1), warned("states no number of facets")
    yield "too-many.stl", binary_stl(stated=13), refused("it is truncated or not an STL file")
    yield "two-binary-solids.stl", binary_stl(of=TRIANGLES[:6]) + binary_stl(of=TRIANGLES[6:])
    yield "gzip.stl", gzip.compress(binary_stl()), refused("unpack it with gunzip")
    yield "step.stl", b"ISO-10303-21;\nHEADER;", refused("it is a STEP file")


def obj_files():
    def vertices(form="v {:g} {:g} {:g}\n", of=VERTICES):
        return "".join(form.format(*v) for v in of)

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
    yield "upper.obj", plain.upper(), refused("it has no vertex")
    yield "cr-and-lf.obj", plain.replace("\n", "\r") + "\n"
    for name in ("utf-16-le", "utf-16-be"):
        yield f"{name}-without-mark.obj", plain.encode(name)
    yield "utf16-cr.obj", ("# gr\u00f6\u00dfe\n" + plain).replace("\n", "\r").encode("utf-16")
    yield "comments.obj", plain.replace("f 1 3 4 2", "f 1 3 4 2 # side").replace("v 30 0 0", "v 30 0 0 # 1 2 3")
    yield "tight-comments.obj", plain.replace("f 1 3 4 2", "f 1 3 4 2#side").replace("v 30 0 0", "v 30 0 0#c")
    yield "continued.obj", plain.replace("f 1 3 4 2", "f 1 3 \\\n4 2").replace("v 30 0 0", "v 30 0\\\n 0")
    yield "continued-crlf.obj", plain.replace("f 1 3 4 2", "f 1 3 \\\n4 2").replace("\n", "\r\n")
    yield "continued-cr.obj", plain.replace("f 1 3 4 2", "f \\\n1 3 4 2").replace("\n", "\r")
    yield "continued-others.obj", "vt 0 \\\n0\nl 1 2 \\\n 3 4 \\\n 5\n" + plain + "p 1 \\\n 2 3\n"
    yield "comment-with-backslash.obj", "# C:\\parts\\\n" + plain
    yield "fo.obj", plain.replace("f 1 3", "fo 1 3")
    powers = vertices("v {:.3e} {:.3e} {:.3e}\n") + faces()
    yield "fortran.obj", powers.replace("e+", "D+")
    yield "bare-powers.obj", powers.replace("e+0", "+00")
    yield "mathematica.obj", powers.replace("e+0", "*^")
    yield "three-digits.obj", powers.replace("e+0", "e+00")
    yield "negative-normals.obj", vertices() + "vn 0 0 1\n" + faces("{0}//-1")
    yield "own-vertices.obj", vertices(of=SOUP) + faces(of=SOUP_FACES), JOINED
    corners = "".join("".join("v {:g} {:g} {:g}\n".format(*VERTICES[i]) for i in q) + "f -4 -3 -2 -1\n" for q in QUADS)
    yield "faces-between.obj", corners, JOINED
    yield "nan-normals.obj", vertices() + "vn nan nan nan\n" * 8 + faces("{0}//{0}")
    yield "color.obj", vertices("v {:g} {:g} {:g} 0.7843 0.3922 0.1961\n") + faces(), colored(RGB)
    yield "color-255.obj", vertices("v {:g} {:g} {:g} 200 100 50\n") + faces(), colored(RGB)
    yield "free-form.obj", plain + "cstype bspline\nsurf 0 1 0 1 1 2 3 4\nend\n", warned("skipped 1 free-form")
    yield "zero.obj", plain + "f 0 1 2\n", refused("'0' is not the index")
    yield "gzip.obj", gzip.compress(plain.encode()), refused("unpack it with gunzip")


def off_files():
    def off(header="OFF\n", vertex="", face=""):
        points = "".join("{:g} {:g} {:g}{}\n".format(*v, vertex) for v in VERTICES)
        return f"{header}8 6 0\n" + points + "".join("4 " + " ".join(map(str, q)) + face + "\n" for q in QUADS)

    yield "plain.off", off()
    yield "one-line.off", off("OFF ")
    yield "normals.off", off("NOFF\n", vertex=" 0 0 1")
    yield "texture.off", off("STOFF\n", vertex=" 0 0")
    yield "face-colors.off", off(face=" 255 0 0")
    yield "remarks.off", off("OFF\n# made by hand\n\n")
    yield "bom.off", "\ufeff" + off()
    yield "utf16.off", off().encode("utf-16")
    yield "cr.off", off().replace("\n", "\r")
    yield "crlf.off", off().replace("\n", "\r\n")
    yield "colors.off", off("COFF\n", vertex=" 200 100 50 255"), colored(RGB)
    yield "float-colors.off", off("COFF\n", vertex=" 0.7843 0.3922 0.1961 1.0"), colored(RGB)
    yield "normals-and-colors.off", off("CNOFF\n", vertex=" 0 0 1 200 100 50 255"), colored(RGB)
    behind = warned("left out behind what its header counts")
    yield "behind.off", off() + "3 0 1 2\n", behind
    yield "remark-behind.off", off() + "# made by hand\n\n"
    yield "fewer-faces.off", off().replace("8 6 0", "8 5 0"), {**behind, "triangles": 10, "area": 2000.0, "volume": 0.0}
    yield "no-header.off", off(""), refused("expected 'OFF'")
    yield "lower.off", off("off\n"), refused("expected 'OFF'")


def all_files():
    return [*ply_files(), *stl_files(), *obj_files(), *off_files()]


if __name__ == "__main__":
    sys.exit(1 if faults_of(pathlib.Path(sys.argv[1]).resolve(), all_files()) else 0)
