"""The box of 30 x 20 x 10 in glTF and 3MF, each as some program writes it: package_quirks_test.py PROGRAM"""
import base64
import gzip
import io
import json
import pathlib
import struct
import sys
import zipfile

from quirks import QUADS, TRIANGLES, VERTICES, boxes, colored, faults_of, refused, warned

CORNERS = [i for t in TRIANGLES for i in t]
SOUP = [VERTICES[i] for i in CORNERS]
JOINED = warned("vertices were joined to 8")
POSITIONS = b"".join(struct.pack("<3f", *(c / 1000 for c in v)) for v in VERTICES)
COMPONENT = {"B": 5121, "h": 5122, "H": 5123, "I": 5125, "f": 5126}


class Gltf:
    """A document in metres, with the box in view and accessor 0 and its corners in 1."""

    def __init__(self, corners=CORNERS, index="H", positions=POSITIONS, mode=4, node=None):
        self.data, self.views, self.accessors = b"", [], []
        self.add(positions, "f", "VEC3", len(positions) // 12)
        self.add(struct.pack(f"<{len(corners)}{index}", *corners), index, "SCALAR", len(corners))
        primitive = {"attributes": {"POSITION": 0}, "mode": mode, **({"indices": 1} if corners else {})}
        self.document = {"asset": {"version": "2.0"}, "meshes": [{"primitives": [primitive]}]}
        self.document |= {"nodes": [{"mesh": 0, **(node or {})}], "scenes": [{"nodes": [0]}]}

    def add(self, data, kind, shape, count, accessor=True):
        """Adds a view, and its accessor; the number of either."""
        self.views.append({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(data)})
        self.data += data + b"\0" * (-len(data) % 4)
        if not accessor:
            return len(self.views) - 1
        number = {"bufferView": len(self.views) - 1, "componentType": COMPONENT[kind], "count": count, "type": shape}
        self.accessors.append(number)
        return len(self.accessors) - 1

    def primitive(self):
        return self.document["meshes"][0]["primitives"][0]

    def text(self, uri=None, **more):
        uri = uri or "data:application/octet-stream;base64," + base64.b64encode(self.data).decode()
        buffers = [{"byteLength": len(self.data), "uri": uri}]
        lists = {"accessors": self.accessors, "bufferViews": self.views, "buffers": buffers}
        return json.dumps({**self.document, **lists, **more})

    def binary(self):
        text = json.loads(self.text())
        text["buffers"] = [{"byteLength": len(self.data)}]
        text = json.dumps(text).encode()
        text += b" " * (-len(text) % 4)
        body = (
            struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(self.data), b"BIN\0") + self.data
        )
        return struct.pack("<4sII", b"glTF", 2, 12 + len(body)) + body


def strip():
    """The faces in one strip, led on by triangles without an area."""
    corners = []
    for a, b, c, d in QUADS:
        corners += [*corners[-1:], *([a] if corners else []), a, b, d, c]
    return corners


def one_face_each(mode):
    gltf = Gltf()
    faces = [q if mode == 6 else (q[0], q[1], q[3], q[2]) for q in QUADS]
    numbers = [gltf.add(struct.pack("<4B", *face), "B", "SCALAR", 4) for face in faces]
    parts = [{"attributes": {"POSITION": 0}, "indices": number, "mode": mode} for number in numbers]
    gltf.document["meshes"][0]["primitives"] = parts
    return gltf.text()


def colors(kind, values, shape):
    gltf = Gltf()
    data = b"".join(struct.pack(f"<{len(values)}{kind}", *values) for _ in VERTICES)
    number = gltf.add(data, kind, shape, 8)
    gltf.accessors[number]["normalized"] = kind != "f"
    gltf.primitive()["attributes"]["COLOR_0"] = number
    return gltf.text()


def sparse(base, index=3):
    """The box whose vertex 3 is somewhere else in the view, or all of whose vertices are sparse."""
    gltf = Gltf(positions=POSITIONS[:36] + struct.pack("<3f", 5, 5, 5) + POSITIONS[48:] if base else POSITIONS)
    indices = gltf.add(struct.pack("<H", index) if base else bytes(range(8)), "", "", 0, accessor=False)
    values = gltf.add(POSITIONS[36:48], "", "", 0, accessor=False) if base else 0
    kind = COMPONENT["H" if base else "B"]
    parts = {"indices": {"bufferView": indices, "componentType": kind}, "values": {"bufferView": values}}
    gltf.accessors[0]["sparse"] = {"count": 1 if base else 8, **parts}
    if not base:
        del gltf.accessors[0]["bufferView"]
    return gltf.text()


def quantized():
    gltf = Gltf(node={"scale": [0.001] * 3})
    data = b"".join(struct.pack("<3h2x", *map(int, v)) for v in VERTICES)
    gltf.primitive()["attributes"]["POSITION"] = number = gltf.add(data, "h", "VEC3", 8)
    gltf.views[gltf.accessors[number]["bufferView"]]["byteStride"] = 8
    return gltf.text(extensionsRequired=["KHR_mesh_quantization"])


def copies():
    gltf = Gltf()
    number = gltf.add(struct.pack("<6f", 0, 0, 0, 0.1, 0, 0), "f", "VEC3", 2)
    copied = {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": number}}}
    gltf.document["nodes"][0]["extensions"] = copied
    return gltf.text()


def gltf_files():
    plain = Gltf()
    yield "plain.glb", plain.binary()
    yield "binary-inside.gltf", plain.binary()
    yield "text-inside.glb", plain.text()
    yield "bom.gltf", "\ufeff" + plain.text()
    for index in "BHI":
        yield f"index-{index}.gltf", Gltf(index=index).text()
    own = b"".join(struct.pack("<3f", *(c / 1000 for c in v)) for v in SOUP)
    yield "no-index.gltf", Gltf([], positions=own).text(), JOINED
    yield "strip.gltf", Gltf(strip(), mode=5).text()
    yield "strip-without-index.gltf", Gltf(
        [], positions=b"".join(POSITIONS[12 * i : 12 * i + 12] for i in strip()), mode=5
    ).text(), warned("vertices were joined")
    yield "strips.gltf", one_face_each(5)
    yield "fans.gltf", one_face_each(6)
    half = 0.70710678
    for number, node in enumerate(
        [{"scale": [-1, 1, 1]}, {"translation": [1, 2, 3]}, {"rotation": [0, 0, half, half]}]
    ):
        yield f"node-{number}.gltf", Gltf(node=node).text()
    yield "matrix.gltf", Gltf(node={"matrix": [-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 5, 5, 1]}).text()
    yield "two-nodes.gltf", plain.text(
        nodes=[{"mesh": 0}, {"mesh": 0, "scale": [1, -1, 1]}], scenes=[{"nodes": [0, 1]}]
    ), boxes(2)
    yield "copies.gltf", copies(), boxes(2)
    yield "sparse.gltf", sparse(base=True)
    yield "all-sparse.gltf", sparse(base=False)
    yield "sparse-beyond.gltf", sparse(base=True, index=300), refused("refers to element 300")
    yield "quantized.gltf", quantized()
    yield "float-colors.gltf", colors("f", (0.5, 0.25, 0.1), "VEC3"), colored((188, 137, 89))
    yield "byte-colors.gltf", colors("B", (128, 64, 26, 255), "VEC4"), colored((188, 137, 90))
    yield "unknown.gltf", plain.text(extensionsRequired=["EXT_odd"]), refused("it requires the extension EXT_odd")
    packed = "EXT_meshopt_compression"
    yield "packed.gltf", plain.text(extensionsRequired=[packed]), refused(f"extension {packed}, which is not read")
    fallback = [{"byteLength": 64, "extensions": {"EXT_meshopt_compression": {"fallback": True}}}]
    yield "meshopt-fallback.gltf", plain.text().replace(
        '"buffers": [', '"buffers": [' + json.dumps(fallback)[1:-1] + ", "
    ), refused("it is compressed (EXT_meshopt_compression)")
    draco = {"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"POSITION": 0}}}
    beside = Gltf()
    beside.primitive()["extensions"] = draco
    yield "draco-beside.gltf", beside.text(extensionsUsed=list(draco))
    alone = Gltf()
    alone.primitive()["extensions"] = draco
    del alone.accessors[0]["bufferView"]
    yield "draco-alone.gltf", alone.text(extensionsUsed=list(draco)), refused("export it without compression")
    hidden = {"extensions": {"KHR_node_visibility": {"visible": False}}}
    nodes = [{"mesh": 0}, {"mesh": 0, "translation": [1, 0, 0], **hidden}]
    yield "hidden-node.gltf", plain.text(nodes=nodes, scenes=[{"nodes": [0, 1]}]), warned(
        "left out 1 node that is hidden"
    )
    yield "shown-node.gltf", plain.text(nodes=[{"mesh": 0, "extensions": {"KHR_node_visibility": {"visible": True}}}])
    yield "materials.gltf", plain.text(extensionsRequired=["KHR_materials_unlit", "KHR_texture_transform"])
    yield "skin.gltf", plain.text(nodes=[{"mesh": 0, "skin": 0}]), warned("is read at rest")
    yield "my box.bin", plain.data, None
    yield "sub/box.bin", plain.data, None
    yield "blank.gltf", plain.text("my%20box.bin")
    yield "below.gltf", plain.text("./sub/box.bin")
    yield "above.gltf", plain.text("sub/../../box.bin"), refused("is not a file in the same folder or below")
    yield "escaped-above.gltf", plain.text("%2e%2e/box.bin"), refused("is not a file in the same folder or below")
    yield "gzip.glb", gzip.compress(plain.binary()), refused("unpack it with gunzip")


CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
PRODUCTION = 'xmlns:p="http://schemas.microsoft.com/3dmanufacturing/production/2015/06"'
MATERIAL = 'xmlns:m="http://schemas.microsoft.com/3dmanufacturing/material/2015/02"'
MODEL = "3D/3dmodel.model"
PART = "3D/Objects/object_1.model"
TURN = 'transform="0 1 0 -1 0 0 0 0 1 5 6 7"'


def solid(mm=1.0, vertices=VERTICES, triangles=TRIANGLES):
    points = "".join('<vertex x="{}" y="{}" z="{}"/>'.format(*(c / mm for c in v)) for v in vertices)
    faces = "".join('<triangle v1="{}" v2="{}" v3="{}"/>'.format(*t) for t in triangles)
    return f"<mesh><vertices>{points}</vertices><triangles>{faces}</triangles></mesh>"


def model(resources=None, build='<item objectid="1"/>', unit="millimeter", more=""):
    resources = f'<object id="1" type="model">{solid()}</object>' if resources is None else resources
    return (
        f'<model unit="{unit}" xmlns="{CORE}" {more}><resources>{resources}</resources><build>{build}</build></model>'
    )


def package(parts, root="/" + MODEL):
    relation = (
        f'<Relationship Target="{root}" Id="r" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>'
    )
    space = "http://schemas.openxmlformats.org/package/2006/relationships"
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w", zipfile.ZIP_DEFLATED) as file:
        file.writestr("_rels/.rels", f'<Relationships xmlns="{space}">{relation}</Relationships>')
        for name, text in parts.items():
            file.writestr(name, text)
    return data.getvalue()


def produced(path="/" + PART, part=PART, mm=1.0, unit="millimeter", more=""):
    """A model whose object is in a file of its own, as slicers write it."""
    component = f'<component p:path="{path}" objectid="1" p:UUID="b" transform="1 0 0 0 1 0 0 0 1 5 5 5"/>'
    objects = f'<object id="2" type="model"><components>{component}{more}</components></object>'
    build = f'<item objectid="2" p:UUID="c" {TURN} printable="1"/>'
    root = model(objects, build, more=f'{PRODUCTION} requiredextensions="p"')
    return package(
        {MODEL: root, part: model(f'<object id="1" type="model">{solid(mm)}</object>', "", unit, PRODUCTION)}
    )


def required(space):
    return package({MODEL: model(more=f'xmlns:e="{space}" requiredextensions="e"')})


def three_mf_files():
    yield "plain.3mf", package({MODEL: model()})
    for unit, mm in {"micron": 0.001, "centimeter": 10, "inch": 25.4, "foot": 304.8, "meter": 1000}.items():
        yield f"{unit}.3mf", package({MODEL: model(f'<object id="1">{solid(mm)}</object>', unit=unit)})
    yield "parsec.3mf", package({MODEL: model(unit="parsec")}), refused("its unit 'parsec' is not defined")
    yield "other-name.3mf", package({"3D/Part.model": model()}, "/3D/Part.model")
    yield "other-case.3mf", package({"3D/3DModel.model": model()})
    yield "utf16.3mf", package({MODEL: model().encode("utf-16")})
    yield "bom.3mf", package({MODEL: "\ufeff" + model()})
    mirrored = '<item objectid="1" transform="-1 0 0 0 1 0 0 0 1 5 5 5"/>'
    yield "mirrored.3mf", package({MODEL: model(build=mirrored)})
    yield "two.3mf", package({MODEL: model(build=mirrored + f'<item objectid="1" {TURN}/>')}), boxes(2)
    both = f'<component objectid="1"/><component objectid="1" {TURN}/>'
    part = f'<object id="1">{solid()}</object>'
    nested = f'{part}<object id="2"><components>{both}</components></object>'
    yield "components.3mf", package({MODEL: model(nested, f'<item objectid="2" {TURN}/>')}), boxes(2)
    yield "produced.3mf", produced()
    yield "produced-inch.3mf", produced(mm=25.4, unit="inch")
    again = f'<component p:path="/{PART}" objectid="1" transform="-1 0 0 0 1 0 0 0 1 -50 0 0"/>'
    yield "produced-twice.3mf", produced(more=again), boxes(2)
    yield "produced-blank.3mf", produced("/3D/Objects/my%20part.model", "3D/Objects/my part.model")
    yield "produced-missing.3mf", produced(part="3D/Objects/other.model"), refused("object_1")
    yield "materials.3mf", required("http://schemas.microsoft.com/3dmanufacturing/material/2015/02")
    for name in ("beamlattice/2017/02", "securecontent/2019/04", "volumetric/2022/01"):
        space = f"http://schemas.microsoft.com/3dmanufacturing/{name}"
        yield f"{name.split('/')[0]}.3mf", required(space), refused(space)
    aid = f'{part}<object id="2" type="support">{solid()}</object>'
    yield "support.3mf", package({MODEL: model(aid, '<item objectid="1"/><item objectid="2"/>')}), warned(
        "left out 1 object"
    )
    group = '<m:colorgroup id="5"><m:color color="#C86432FF"/></m:colorgroup>'
    of_color = f'{group}<object id="1" pid="5" pindex="0">{solid()}</object>'
    yield "colors.3mf", package({MODEL: model(of_color, more=MATERIAL)}), colored((200, 100, 50))
    own = (
        f'<object id="1">{solid(vertices=SOUP, triangles=[tuple(range(3 * i, 3 * i + 3)) for i in range(12)])}</object>'
    )
    yield "own-vertices.3mf", package({MODEL: model(own)}), JOINED
    lattice = 'xmlns:b="http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02"'
    beams = (
        '<b:beamlattice minlength="1"><b:beams><b:beam v1="0" v2="7"/><b:beam v1="1" v2="6"/></b:beams></b:beamlattice>'
    )
    of_beams = f'<object id="1">{solid().replace("</mesh>", beams + "</mesh>")}</object>'
    yield "beams.3mf", package({MODEL: model(of_beams, more=lattice)}), warned(
        "left out 2 beams or shapes of extensions"
    )
    required_beams = package({MODEL: model(of_beams, more=lattice + ' requiredextensions="b"')})
    yield "required-beams.3mf", required_beams, refused("beamlattice/2017/02; export it as triangles")
    boolean = 'xmlns:bo="http://schemas.3mf.io/3dmanufacturing/booleanoperations/2023/07"'
    cut = '<object id="2"><bo:booleanshape objectid="1"><bo:boolean objectid="1"/></bo:booleanshape></object>'
    both = model(f'<object id="1">{solid()}</object>{cut}', '<item objectid="1"/><item objectid="2"/>', more=boolean)
    yield "boolean.3mf", package({MODEL: both}), warned("left out 1 beam or shape of extensions")
    yield "nothing.3mf", package({MODEL: model(build="")}), refused("its build items have no triangles")
    yield "gzip.3mf", gzip.compress(package({MODEL: model()})), refused("unpack it with gunzip")


def packed_files():
    """Files that are packed are named, whatever their ending."""
    with io.BytesIO() as data:
        with zipfile.ZipFile(data, "w") as file:
            file.writestr("part.stl", "solid")
        for name in ("part.stl.zip", "part.stl", "part.obj"):
            yield name, data.getvalue(), refused("it is a zip archive")
    yield "part.ply.gz", gzip.compress(b"ply"), refused("it is compressed by gzip")


def all_files():
    return [*gltf_files(), *three_mf_files(), *packed_files()]


if __name__ == "__main__":
    sys.exit(1 if faults_of(pathlib.Path(sys.argv[1]).resolve(), all_files()) else 0)
