"""Bodies that touch, with vertices of their own, in every format: touching_quirks_test.py PROGRAM

Two boxes of 30 x 20 x 10 share an edge, a corner or a face. Formats whose triangles repeat coordinates must keep them apart:
two components without an edge of more than two triangles, whatever the sense of their triangles.
"""
import pathlib
import struct
import sys

from package_quirks_test import Gltf, MODEL, model, package, solid
from drawing_quirks_test import dxf, faces, groups
from quirks import QUADS, TRIANGLES, VERTICES, boxes, faults_of, warned

PLACES = {
    "edge": (30, 20, 0),
    "corner": (30, 20, 10),
    "face": (30, 0, 0),
    "part-of-face": (30, 5, 2),
    "apart": (50, 0, 0),
}


def moved(by):
    return [tuple(a + b for a, b in zip(v, by)) for v in VERTICES]


def bodies(by, inverted=False):
    """The triangles of two boxes, each by its corners."""
    order = (0, 2, 1) if inverted else (0, 1, 2)
    return [tuple(of[t[k]] for k in order) for of in (VERTICES, moved(by)) for t in TRIANGLES]


def mixed(triangles):
    """The triangles in another order, so that those of both bodies alternate."""
    half = len(triangles) // 2
    return [t for pair in zip(triangles[:half], triangles[half:]) for t in pair]


def binary_stl(triangles):
    facets = [struct.pack("<12fH", 0, 0, 0, *(c for corner in t for c in corner), 0) for t in triangles]
    return b"x".ljust(80) + struct.pack("<I", len(triangles)) + b"".join(facets)


def text_stl(triangles, solids=1):
    share = len(triangles) // solids
    text = ""
    for begin in range(0, len(triangles), share):
        text += "solid part\n"
        for t in triangles[begin : begin + share]:
            corners = "".join("vertex {:g} {:g} {:g}\n".format(*corner) for corner in t)
            text += f"facet normal 0 0 0\nouter loop\n{corners}endloop\nendfacet\n"
        text += "endsolid part\n"
    return text


def soup(triangles):
    """Vertices and faces where each triangle has vertices of its own."""
    return [c for t in triangles for c in t], [tuple(range(3 * i, 3 * i + 3)) for i in range(len(triangles))]


def lines(form, rows):
    return "".join(form.format(*row) for row in rows)


def text_ply(triangles):
    vertices, corners = soup(triangles)
    axes = "property float x\nproperty float y\nproperty float z\n"
    header = f"ply\nformat ascii 1.0\nelement vertex {len(vertices)}\n{axes}element face {len(corners)}\n"
    return (
        f"{header}property list uchar int vertex_indices\nend_header\n"
        + lines("{:g} {:g} {:g}\n", vertices)
        + lines("3 {} {} {}\n", corners)
    )


def obj(triangles):
    vertices, corners = soup(triangles)
    return lines("v {:g} {:g} {:g}\n", vertices) + lines("f {} {} {}\n", [[i + 1 for i in t] for t in corners])


def off(triangles):
    vertices, corners = soup(triangles)
    return (
        f"OFF\n{len(vertices)} {len(corners)} 0\n"
        + lines("{:g} {:g} {:g}\n", vertices)
        + lines("3 {} {} {}\n", corners)
    )


def gltf(triangles):
    vertices, corners = soup(triangles)
    positions = b"".join(struct.pack("<3f", *(c / 1000 for c in v)) for v in vertices)
    return Gltf([i for t in corners for i in t], positions=positions).text()


def three_mf(triangles):
    vertices, corners = soup(triangles)
    return package({MODEL: model(f'<object id="1">{solid(vertices=vertices, triangles=corners)}</object>')})


def face_drawing(triangles):
    vertices, corners = soup(triangles)
    return dxf(faces(quads=[(*t, t[2]) for t in corners], vertices=vertices))


def polyfaces(by):
    """A polyface for each box: vertices are shared in one of them."""
    text = ""
    for vertices in (VERTICES, moved(by)):
        text += groups(0, "POLYLINE", 8, "0", 66, 1, 70, 64, 71, 8, 72, 6)
        for v in vertices:
            text += groups(0, "VERTEX", 8, "0", 10, v[0], 20, v[1], 30, v[2], 70, 192)
        for quad in QUADS:
            text += groups(0, "VERTEX", 8, "0", 70, 128, *(w for k, i in enumerate(quad) for w in (71 + k, i + 1)))
        text += groups(0, "SEQEND", 8, "0")
    return dxf(text)


WRITERS = {"stl": binary_stl, "text.stl": text_stl, "ply": text_ply, "obj": obj, "off": off, "gltf": gltf}
WRITERS |= {"3mf": three_mf, "dxf": face_drawing}
SAID = {"ply", "obj", "off", "gltf", "3mf"}  # formats in which vertices can be shared: their soup is named


def all_files():
    apart = {**boxes(2), "components": 2, "non_manifold": 0}
    for where, by in PLACES.items():
        for ending, write in WRITERS.items():
            said = warned("vertices were joined to 16", apart) if ending in SAID else apart
            yield f"{where}.{ending}", write(bodies(by)), said
            yield f"{where}-mixed.{ending}", write(mixed(bodies(by))), said
            inside_out = {**said, "volume": -apart["volume"]}
            yield f"{where}-inverted.{ending}", write(bodies(by, inverted=True)), inside_out
        yield f"{where}-two-solids.stl", text_stl(bodies(by), 2), apart
        yield f"{where}-polyface.dxf", polyfaces(by), apart
    two = [*VERTICES, *moved((30, 20, 0))]
    number = {v: i for i, v in enumerate(dict.fromkeys(two))}
    shared = [tuple(number[c] for c in t) for t in bodies((30, 20, 0))]
    indexed = f"OFF\n{len(number)} 24 0\n" + lines("{:g} {:g} {:g}\n", number) + lines("3 {} {} {}\n", shared)
    yield "shared-edge.off", indexed, {**boxes(2), "non_manifold": 1}  # as the file states it


if __name__ == "__main__":
    sys.exit(1 if faults_of(pathlib.Path(sys.argv[1]).resolve(), all_files()) else 0)
