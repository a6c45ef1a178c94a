"""The box of 30 x 20 x 10 that the tests of quirks write, and how they read it."""
import json
import pathlib
import subprocess
import tempfile

VERTICES = [(x, y, z) for z in (0, 10.0) for y in (0, 20.0) for x in (0, 30.0)]
QUADS = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
TRIANGLES = [t for q in QUADS for t in ((q[0], q[1], q[2]), (q[0], q[2], q[3]))]
BOX = {"triangles": 12, "area": 2200.0, "volume": 6000.0}
POINTS = {"points": 8}


def boxes(count):
    """What several boxes have together."""
    return {key: count * value for key, value in BOX.items()}


def refused(sentence):
    """A file that is refused, with a part of the sentence."""
    return {"refused": sentence}


def warned(sentence, what=None):
    """A file that is read with a warning that holds the words."""
    return {**(what or BOX), "warned": sentence}


def colored(color, what=None):
    """A file whose first vertex has a colour."""
    return {**(what or BOX), "color": color}


def first_color(path):
    """Red, green and blue of the first vertex of a binary PLY."""
    data = path.read_bytes()
    header, body = data[: data.index(b"end_header")].decode(), data[data.index(b"end_header\n") + 11 :]
    place, sizes = {}, {"float": 4, "uchar": 1, "ushort": 2}
    offset = 0
    for line in header[header.index("element vertex") : header.index("element face")].splitlines()[1:]:
        _, kind, name = line.split()
        place[name] = offset
        offset += sizes[kind]
    return tuple(body[place[name]] for name in ("red", "green", "blue")) if "red" in place else None


def fault_of(program, folder, name, expected):
    """What is wrong with how a file is read; empty where nothing is."""
    saved = ["-o", "out.ply"] if expected.keys() & {"color", "points"} else []
    command = [program, "--json", "edit", name, *saved]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    answer = json.loads(done.stdout)
    message = answer.get("error", {}).get("message", "")
    if "refused" in expected:
        right = expected["refused"] in message and done.returncode == 3
        return "" if right else f"it is not refused: {message or answer}"
    if message:
        return message
    warnings = " ".join(answer["warnings"])
    if expected.get("warned", "") not in warnings or ("warned" not in expected and warnings):
        return f"warnings: {warnings or 'none'}"
    if "color" in expected:
        color = first_color(folder / "out.ply")
        if color is None or max(abs(a - b) for a, b in zip(color, expected["color"])) > 1:
            return f"colour {color}"
    if "points" in expected:
        return "" if answer["vertices"] == expected["points"] else f"{answer['vertices']} points"
    for key, place in {"triangles": "triangles", "area": "area_mm2", "volume": "volume_mm3"}.items():
        if key in expected and abs((answer.get(place) or 0.0) - expected[key]) > 2e-5 * abs(expected[key]):
            return f"{key} {answer.get(place)}"
    if "components" in expected and len(answer["components"]) != expected["components"]:
        return f"{len(answer['components'])} components"
    if answer["non_manifold_edges"] != expected.get("non_manifold", answer["non_manifold_edges"]):
        return f"{answer['non_manifold_edges']} edges of more than two triangles"
    return ""


def faults_of(program, files):
    """The faults of all files: name, content as text or bytes, and what is right (the box, if left out)."""
    faults, count = [], 0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for name, data, *expected in files:
            path = folder / name
            path.parent.mkdir(exist_ok=True)
            path.write_bytes(data if isinstance(data, bytes) else data.encode())
            if expected == [None]:
                continue  # a file that another one names
            fault = fault_of(program, folder, name, expected[0] if expected else BOX)
            count += 1
            if fault:
                faults.append(f"{name}: {fault}")
    print("\n".join(faults) or f"{count} files are read or refused as they should be")
    return faults
