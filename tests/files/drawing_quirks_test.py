"""The box of 30 x 20 x 10 in DXF, XYZ and PCD, each as some program writes it: drawing_quirks_test.py PROGRAM"""
import pathlib
import struct
import sys

from quirks import POINTS, QUADS, VERTICES, boxes, colored, faults_of, refused, warned

RGB = (200, 100, 50)
PACKED = RGB[0] << 16 | RGB[1] << 8 | RGB[2]
# mm of $INSUNITS 0 to 24: Autodesk, DXF Reference 2024, HEADER section
MM_OF_UNIT = [1, 25.4, 304.8, 1609344, 1, 10, 1000, 1e6, 25.4e-6, 0.0254, 914.4, 1e-7, 1e-6, 1e-3, 100, 1e4, 1e5, 1e12]
MM_OF_UNIT += [149597870700000.0, 9.4607304725808e18, 3.0856775814913673e19]
MM_OF_UNIT += [1200e3 / 3937, 100e3 / 3937, 3600e3 / 3937, 6336e6 / 3937]


def groups(*pairs):
    return "".join(f"{code:3d}\n{value}\n" for code, value in zip(pairs[::2], pairs[1::2]))


def faces(layer="0", mm=1.0, more=(), quads=QUADS, vertices=VERTICES):
    text = ""
    for quad in quads:
        corners = [(10 + 10 * axis + k, c / mm) for k, i in enumerate(quad) for axis, c in enumerate(vertices[i])]
        text += groups(0, "3DFACE", 8, layer, *more, *(word for corner in corners for word in corner))
    return text


def large(layer="0", more=()):
    """A face that would be seen at once."""
    return faces(layer, 1.0, more, [(0, 1, 2, 3)], [(0, 0, 0), (1000, 0, 0), (1000, 1000, 0), (0, 1000, 0)])


def section(name, body):
    return groups(0, "SECTION", 2, name) + body + groups(0, "ENDSEC")


def dxf(entities, blocks="", layers=(), unit=4, imperial=False):
    header = (groups(9, "$MEASUREMENT", 70, 0) if imperial else "") + groups(9, "$INSUNITS", 70, unit)
    table = "".join(groups(0, "LAYER", 2, name, 70, flags, 62, color) for name, flags, color in layers)
    tables = section("TABLES", groups(0, "TABLE", 2, "LAYER") + table + groups(0, "ENDTAB")) if layers else ""
    return (
        section("HEADER", header)
        + tables
        + section("BLOCKS", blocks)
        + section("ENTITIES", entities)
        + groups(0, "EOF")
    )


def block(body, name="B", base=(0, 0, 0), more=()):
    begin = groups(0, "BLOCK", 8, "0", 2, name, *more, 10, base[0], 20, base[1], 30, base[2])
    return begin + body + groups(0, "ENDBLK", 8, "0")


def insert(name="B", at=(0, 0, 0), layer="0", more=()):
    return groups(0, "INSERT", 8, layer, 2, name, 10, at[0], 20, at[1], 30, at[2], *more)


def mesh_entity(level=0):
    entries = [word for quad in QUADS for word in (90, 4, *(word for i in quad for word in (90, i)))]
    points = [word for v in VERTICES for word in (10, v[0], 20, v[1], 30, v[2])]
    return groups(0, "MESH", 8, "0", 91, level, 92, 8, *points, 93, 30, *entries, 94, 0, 95, 0)


def polyface():
    text = groups(0, "POLYLINE", 8, "0", 66, 1, 70, 64, 71, 8, 72, 6)
    for v in VERTICES:
        text += groups(0, "VERTEX", 8, "0", 10, v[0], 20, v[1], 30, v[2], 70, 192)
    for quad in QUADS:  # a negative index hides an edge
        text += groups(
            0, "VERTEX", 8, "0", 70, 128, *(w for k, i in enumerate(quad) for w in (71 + k, (i + 1) * (-1) ** k))
        )
    return text + groups(0, "SEQEND", 8, "0")


def dxf_files():
    for unit, mm in enumerate(MM_OF_UNIT):
        yield f"unit-{unit}.dxf", dxf(faces(mm=mm), unit=unit)
    yield "unit-25.dxf", dxf(faces(), unit=25), warned("$INSUNITS 25 is no unit")
    yield "imperial.dxf", dxf(faces(), unit=0, imperial=True), warned("it is an imperial drawing")
    plain = dxf(faces())
    yield "bom.dxf", "\ufeff" + plain
    yield "cr.dxf", plain.replace("\n", "\r")
    yield "crlf.dxf", plain.replace("\n", "\r\n")
    yield "utf16.dxf", plain.encode("utf-16")
    yield "fortran.dxf", plain.replace("30.0", "3.0D+01")
    yield "dwg.dxf", b"AC1032\0\0", refused("it is a DWG drawing")
    hidden = warned("left out 1 mesh of layers that are off or frozen")
    yield "off.dxf", dxf(faces() + large("H"), layers=[("H", 0, -3)]), hidden
    yield "frozen.dxf", dxf(faces() + large("h"), layers=[("H", 1, 3)]), hidden
    yield "locked.dxf", dxf(faces("L"), layers=[("L", 4, 3)])
    yield "only-off.dxf", dxf(large("H"), layers=[("H", 0, -3)]), refused("only 1 mesh of layers that are off")
    yield "paper.dxf", dxf(faces() + large(more=(67, 1))), warned("left out 1 mesh of paper space")
    yield "other-layout.dxf", dxf(faces(), block(large(), "*Paper_Space0")), warned("left out 1 mesh of paper space")
    yield "invisible.dxf", dxf(faces() + large(more=(60, 1))), warned("left out 1 mesh that is invisible")
    yield "mesh.dxf", dxf(mesh_entity())
    yield "cage.dxf", dxf(mesh_entity(2)), warned("the cage is read")
    yield "polyface.dxf", dxf(polyface())
    yield "solid.dxf", dxf(faces() + groups(0, "3DSOLID", 8, "0", 1, "x")), warned("skipped 1 3DSOLID")
    yield "extended-data.dxf", plain.replace("  8\n0\n", "  8\n0\n1001\nACAD\n1010\n5.0\n1020\n6.0\n", 1)
    yield "insert.dxf", dxf(insert(), block(faces()))
    yield "insert-polyface.dxf", dxf(insert(more=(50, 90)), block(polyface()))
    yield "insert-small-letters.dxf", dxf(insert("b"), block(faces()))
    scaled = {"triangles": 12, "area": 16800.0, "volume": 144000.0}
    yield "insert-scale.dxf", dxf(insert(more=(41, 2, 42, 3, 43, 4)), block(faces())), scaled
    for number, more in enumerate([(41, -1), (41, -1, 42, -1), (43, -1), (230, -1), (210, 1, 230, 0), (50, -450)]):
        yield f"insert-turned-{number}.dxf", dxf(insert(more=more), block(faces(), base=(1, 2, 3)))
    array = (70, 3, 71, 2, 44, 100, 45, 50)
    yield "array.dxf", dxf(insert(more=array), block(faces())), boxes(6)
    yield "array-turned.dxf", dxf(insert(more=(50, 90, *array)), block(faces())), boxes(6)
    nested = block(insert(at=(50, 0, 0)) + insert(at=(0, 100, 0), more=(41, -1)), "A") + block(faces())
    yield "nested.dxf", dxf(insert("A", more=(50, 30)), nested), boxes(2)
    yield "nested-arrays.dxf", dxf(insert("A", more=(70, 2, 44, 1000)), nested), boxes(4)
    yield "endless.dxf", dxf(insert(), block(insert())), refused("a block contains itself")
    yield "missing.dxf", dxf(faces() + insert("X")), warned("left out 1 INSERT of blocks")
    other = block("", "X", more=(70, 4, 1, "other.dwg"))
    yield "external.dxf", dxf(faces() + insert("X"), other), warned("of the external drawing 'other.dwg'")
    # What a block has on layer 0 is on the layer of its INSERT, which hides nothing else unless it is frozen.
    yield "layer-0-off.dxf", dxf(insert(layer="V"), block(faces()), layers=[("0", 0, -7), ("V", 0, 3)])
    yield "insert-off.dxf", dxf(faces() + insert(layer="H"), block(large()), layers=[("H", 0, -3)]), hidden
    yield "insert-off-inside-on.dxf", dxf(insert(layer="H"), block(faces("V")), layers=[("H", 0, -3)])
    yield "insert-frozen.dxf", dxf(faces() + insert(layer="H"), block(large("V")), layers=[("H", 1, 3)]), hidden
    yield "inside-off.dxf", dxf(insert(), block(faces("V") + large("H")), layers=[("H", 0, -3)]), hidden
    yield "insert-paper.dxf", dxf(faces() + insert(more=(67, 1)), block(large())), warned("of paper space")


def xyz(separator=" ", behind="", end="\n"):
    return "".join(separator.join(f"{c:g}" for c in v) + behind + end for v in VERTICES)


def xyz_files():
    left_out = warned("what is behind x, y and z is left out", POINTS)
    yield "plain.xyz", xyz(), POINTS
    yield "tabs.xyz", xyz("\t"), POINTS
    yield "cr.xyz", xyz(end="\r"), POINTS
    yield "bom.xyz", "\ufeff" + xyz(), POINTS
    yield "utf16.xyz", xyz().encode("utf-16"), POINTS
    yield "remarks.xyz", "# x y z\n//X Y Z R G B\n" + xyz(), POINTS
    yield "normals.xyz", xyz(behind=" 0 0 1"), POINTS
    yield "colors.xyz", xyz(behind=" 200 100 50"), colored(RGB, POINTS)
    yield "float-colors.xyz", xyz(behind=" 0.7843 0.3922 0.1961"), colored(RGB, POINTS)
    yield "colors-normals.xyz", xyz(behind=" 200 100 50 0 0 1"), colored(RGB, POINTS)
    yield "normals-colors.xyz", xyz(behind=" 0 0 1 200 100 50"), colored(RGB, POINTS)
    yield "black.xyz", xyz(behind=" 0 0 0"), colored((0, 0, 0), POINTS)
    yield "intensity.xyz", xyz(behind=" 123"), left_out
    yield "intensity-colors.xyz", xyz(behind=" 0.5 200 100 50"), left_out
    yield "commas.xyz", xyz(","), POINTS
    yield "commas-blanks.xyz", xyz(", "), POINTS
    yield "commas-at-the-end.xyz", xyz(",", behind=","), POINTS
    yield "semicolons.xyz", xyz(";"), POINTS
    yield "commas-colors.xyz", xyz(",", behind=",200,100,50"), colored(RGB, POINTS)
    decimal = refused("its numbers have decimal commas")
    yield "decimal-commas.xyz", xyz().replace("30", "30,5").replace("0 ", "0,0 "), decimal
    yield "decimal-commas-tabs.xyz", "1,5\t2,5\t3,5\n", decimal
    yield "decimal-commas-semicolons.xyz", "1,5;2,5;3,5\n", decimal
    missing = refused("a value is missing beside a comma or semicolon")
    for number, line in enumerate(["1,2,,200,100,50", ",", "1,2, ,3", ";1;2;3", "1\t,\t,2,3"]):
        yield f"missing-value-{number}.xyz", xyz(",") + line + "\n", missing
    yield "remark-with-commas.xyz", "# x, y; z\n" + xyz(behind=" # a, b; c"), POINTS
    yield "count.xyz", "8\n" + xyz(), POINTS
    yield "count-commas.xyz", "8\n" + xyz(","), POINTS
    yield "other-count.xyz", "9\n" + xyz(), refused("its first line states 9 points, but it has 8")
    yield "huge-count.xyz", "1e30\n" + xyz(), refused("a point needs three")
    yield "atoms.xyz", "1\nwater\nO 0 0 0\n", refused("names of columns begin with x, y and z")
    yield "names.xyz", "X Y Z\n" + xyz(), POINTS
    yield "names-quoted.csv.xyz", '"x","y","z","r","g","b"\n' + xyz(",", behind=",200,100,50"), colored(RGB, POINTS)
    yield "names-units.xyz", "# by hand\n\nx_mm;y_mm;z_mm\n" + xyz(";"), POINTS
    yield "other-names.xyz", "id,x,y,z\n" + xyz(","), refused("names of columns begin with x, y and z")
    yield "other-units.xyz", "x_m y_m z_m\n" + xyz(), refused("names of columns begin with x, y and z")
    yield "names-twice.xyz", xyz() + "X Y Z\n" + xyz(), refused("is not a number")


def pcd(types="F4 F4 F4", fields="x y z", rows=None, data="ascii", end="\n", width=8):
    words = types.split()
    header = ["# .PCD v0.7 - Point Cloud Data file format", "VERSION 0.7", f"FIELDS {fields}"]
    header += ["SIZE " + " ".join(w[1] for w in words), "TYPE " + " ".join(w[0] for w in words)]
    header += ["COUNT" + " 1" * len(words), f"WIDTH {width}", f"HEIGHT {8 // width}", "VIEWPOINT 0 0 0 1 0 0 0"]
    text = end.join([*header, "POINTS 8", f"DATA {data}", ""])
    rows = rows or VERTICES
    if data.lower() == "ascii":
        return (text + "".join(" ".join(map(str, row)) + end for row in rows)).encode()
    letters = {"F4": "f", "F8": "d", "U4": "I", "I4": "i", "I2": "h", "U1": "B", "U2": "H"}
    return text.encode() + b"".join(struct.pack("<" + letters[w], v) for row in rows for w, v in zip(words, row))


def pcd_files():
    right = colored(RGB, POINTS)
    as_float = struct.unpack("<f", struct.pack("<I", PACKED))[0]
    for data in ("ascii", "binary", "ASCII"):
        yield f"plain-{data}.pcd", pcd(data=data), POINTS
        for kind, value in [("F4", as_float), ("U4", PACKED), ("U4", PACKED | 0xFF000000), ("I4", PACKED - (1 << 24))]:
            for name in ("rgb", "rgba"):
                rows = [(*v, value) for v in VERTICES]
                yield f"{name}-{kind}-{value:.0f}-{data}.pcd", pcd(
                    f"F8 F4 F4 {kind}", f"x y z {name}", rows, data
                ), right
        for kind, value in [("U1", 1), ("F4", 1.0), ("U2", 257), ("F4", 1 / 255)]:
            rows = [(*v, *(c * value for c in RGB)) for v in VERTICES]
            types = "F4 F4 F4" + 3 * f" {kind}"
            for names in ("r g b", "red green blue"):
                yield f"{names[0]}-{names[2]}-{kind}-{value:.0f}-{data}.pcd", pcd(
                    types, f"x y z {names}", rows, data
                ), right
        yield f"two-channels-{data}.pcd", pcd(
            "F4 F4 F4 U1 U1", "x y z r g", [(*v, 1, 2) for v in VERTICES], data
        ), POINTS
        more = pcd(rows=[*VERTICES, (1, 2, 3)], data=data)
        yield f"more-{data}.pcd", more, warned("left out behind what its header counts", POINTS)
    moved = warned("its VIEWPOINT, the pose of the sensor (1 2 3 1 0 0 0), is not applied", POINTS)
    yield "viewpoint.pcd", pcd().replace(b"VIEWPOINT 0 0 0", b"VIEWPOINT 1 2 3"), moved
    turned = pcd().replace(b"VIEWPOINT 0 0 0 1 0 0 0", b"VIEWPOINT 0 0 0 0.7071 0 0 0.7071")
    yield "turned.pcd", turned, warned("its VIEWPOINT", POINTS)
    yield "viewpoint-without-turn.pcd", pcd().replace(b"VIEWPOINT 0 0 0 1 0 0 0", b"VIEWPOINT 0 0 0"), POINTS
    yield "viewpoint-words.pcd", pcd().replace(b"VIEWPOINT 0", b"VIEWPOINT none"), refused("'none' is not a number")
    yield "cr.pcd", pcd(end="\r"), POINTS
    yield "bom.pcd", b"\xef\xbb\xbf" + pcd(), POINTS
    yield "organized.pcd", pcd(width=4), POINTS
    yield "whole.pcd", pcd("I2 I2 I2", rows=[tuple(map(int, v)) for v in VERTICES], data="binary"), POINTS
    nan = [*VERTICES[:7], ("nan", "nan", "nan")]
    yield "nan.pcd", pcd(rows=nan), warned("omitted 1 point", {"points": 7})
    yield "far.pcd", pcd("F8 F8 F8", rows=[(1e7 + x, y, z) for x, y, z in VERTICES]), warned("lies 1e+04 m", POINTS)
    yield "compressed.pcd", pcd(data="binary_compressed", rows=[()]), refused("this PCD is compressed")


def all_files():
    return [*dxf_files(), *xyz_files(), *pcd_files()]


if __name__ == "__main__":
    sys.exit(1 if faults_of(pathlib.Path(sys.argv[1]).resolve(), all_files()) else 0)
