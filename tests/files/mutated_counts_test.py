"""Reads mutated files with every reader, and compares the counts of those that are read with what the files state.

    mutated_counts_test.py MESH_COUNTS COUNT [--seed N] [--keep FOLDER] [--state FILE]

MESH_COUNTS is the program of fuzz/mesh_counts.cpp; built with sanitizers, it names what is wrong with memory. Samples are the
files of the tests of quirks and the calibrations of tests/exchange/data. A program that ends, that takes more than 10 s of
processor time for a file or more than the 2 GB that a small file may take, or a count that differs from the stated one
without a warning is a fault. With --state, a run that was stopped goes on where it was.
"""
import argparse
import io
import json
import os
import pathlib
import random
import re
import select
import struct
import subprocess
import sys
import tempfile
import zipfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "faults")]

import drawing_quirks_test  # noqa: E402
import package_quirks_test  # noqa: E402
import quirks_test  # noqa: E402
from mutate_inputs import mutate  # noqa: E402

CALIBRATIONS = HERE.parent / "exchange" / "data"
MOST_S = 10  # of processor time
MOST_MB = 2000  # docs/files.md, "Damaged files"
WITH_SANITIZERS = 4  # times the time and memory of a usual program


def samples():
    """Small files of every format, by their endings."""
    files = [*quirks_test.all_files(), *drawing_quirks_test.all_files(), *package_quirks_test.all_files()]
    found = [
        (pathlib.Path(name).suffix, data if isinstance(data, bytes) else data.encode()) for name, data, *_ in files
    ]
    found += [(path.suffix, path.read_bytes()) for path in sorted(CALIBRATIONS.iterdir())]
    return [(ending, data) for ending, data in found if ending not in (".bin", ".zip", ".gz")]


def text_of(data):
    """ASCII with line ends of one kind."""
    if b"\0" in data:
        raise ValueError("UTF-16, or damaged")
    return re.sub(r"\r+\n?", "\n", data.decode("ascii"))


def stated_stl(data):
    if len(data) >= 84 and len(data) == 84 + 50 * struct.unpack("<I", data[80:84])[0]:
        return "triangles", (len(data) - 84) // 50
    text = text_of(data).lower()
    return "triangles", len(re.findall(r"^\s*facet\s+normal\b", text, re.MULTILINE))


def stated_obj(data):
    text = text_of(data).replace("\\\n", " ")
    faces = re.findall(r"^[ \t]*fo?[ \t]+([^#\r\n]*)", text, re.MULTILINE)
    return "triangles", sum(len(face.split()) - 2 for face in faces)


def stated_off(data):
    lines = [line.split("#")[0].split() for line in text_of(data).split("\n")]
    words = [line for line in lines if line]
    counts = words[0][1:] if len(words[0]) > 1 else words.pop(1)
    vertices, faces = int(counts[0]), int(counts[1])
    return "triangles", sum(int(line[0]) - 2 for line in words[1 + vertices : 1 + vertices + faces])


def stated_ply(data):
    """Of a text whose elements have a line each, and of binary triangles."""
    header, body = data.split(b"end_header", 1)
    elements = re.findall(rb"^element\s+(\w+)\s+(\d+)", header, re.MULTILINE)
    if [name for name, _ in elements] != [b"vertex", b"face"] or b"format ascii" not in header:
        raise ValueError("not counted")
    vertices, faces = (int(count) for _, count in elements)
    width = header.count(b"property", header.index(b"element vertex"), header.index(b"element face"))
    lines = [line.split() for line in text_of(body).split("\n")[1:] if line.strip()]
    of_faces = lines[vertices : vertices + faces]
    if any(len(line) != width for line in lines[:vertices]) or any(len(f) != 1 + int(f[0]) for f in of_faces):
        raise ValueError("not a line each")
    return "triangles", sum(int(line[0]) - 2 for line in of_faces)


def stated_xyz(data):
    lines = [line.strip() for line in text_of(data).split("\n")]
    lines = [line for line in lines if line and not line.startswith(("#", "//"))]
    before = re.match(r'["xX]|[\d.+eE]+[,;]?$', lines[0]) if lines else None  # names of columns, a number of points
    return "points", len(lines) - (before is not None)


def stated_pcd(data):
    return "points", int(re.search(rb"^POINTS[ \t]+(\d+)[ \t]*\r?$", data, re.MULTILINE).group(1))


def stated_gltf(data):
    if data.startswith(b"glTF"):
        data = data[20 : 20 + struct.unpack("<I", data[12:16])[0]]
    document = json.loads(data)
    parts = [part for mesh in document["meshes"] for part in mesh["primitives"]]
    one = len(document["nodes"]) == 1 and "extensions" not in document["nodes"][0]
    if not one or any(part.get("mode", 4) != 4 or "indices" not in part for part in parts):
        raise ValueError("not counted")
    return "triangles", sum(document["accessors"][part["indices"]]["count"] for part in parts) // 3


def stated_3mf(data):
    with zipfile.ZipFile(io.BytesIO(data)) as package:
        text = package.read("3D/3dmodel.model").decode("ascii")
    if text.count("<item ") != 1 or "<component" in text:
        raise ValueError("not counted")
    return "triangles", text.count("<triangle ")


def stated_dxf(data):
    """Only faces in the entities, with four corners each; the fourth of a triangle is the third or the first."""
    entities = re.split(r"\n *2\nENTITIES\n", text_of(data))
    faces = re.split(r"^ *0+\n(?=\w)", entities[1], flags=re.MULTILINE)[1:]
    names = [face.split("\n")[0] for face in faces]
    if len(entities) != 2 or set(names) != {"3DFACE", "ENDSEC", "EOF"}:
        raise ValueError("not counted")
    for face in faces[: names.index("ENDSEC")]:
        pairs = dict(zip(*[iter(line.strip() for line in face.split("\n")[1:])] * 2))
        corners = [tuple(float(pairs[f"{axis}{k}"]) for axis in (1, 2, 3)) for k in (3, 2, 0)]
        if corners[0] in corners[1:]:
            raise ValueError("a triangle")
    return "triangles", 2 * names.count("3DFACE")


COUNTERS = {".stl": stated_stl, ".obj": stated_obj, ".off": stated_off, ".ply": stated_ply, ".xyz": stated_xyz}
COUNTERS |= {".pcd": stated_pcd, ".gltf": stated_gltf, ".glb": stated_gltf, ".3mf": stated_3mf, ".dxf": stated_dxf}


def stated(ending, data):
    """What a file states: which count, and the count; nothing where this script cannot tell."""
    try:
        return COUNTERS[ending](data)
    except (
        KeyError,
        ValueError,
        IndexError,
        TypeError,
        AttributeError,
        struct.error,
        zipfile.BadZipFile,
        RuntimeError,
    ):
        return None
    except (NotImplementedError, OSError, EOFError, zipfile.zlib.error):  # of a damaged archive
        return None


class Reader:
    """A process that reads one file after the other."""

    def __init__(self, program):
        self.program = program
        self.slow = WITH_SANITIZERS if "asan" in str(program) else 1
        self.start()

    def start(self):
        options = os.environ | {"ASAN_OPTIONS": f"hard_rss_limit_mb={MOST_MB * self.slow}:detect_leaks=0"}
        self.process = subprocess.Popen(
            [self.program], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=options
        )

    def cpu_s(self):
        fields = pathlib.Path(f"/proc/{self.process.pid}/stat").read_text().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def peak_mb(self):
        status = pathlib.Path(f"/proc/{self.process.pid}/status").read_text()
        return int(re.search(r"VmHWM:\s+(\d+)", status).group(1)) / 1024

    def ask(self, path):
        """The answer about a file and what is wrong."""
        begin = self.cpu_s()
        self.process.stdin.write(f"{path}\n".encode())
        self.process.stdin.flush()
        while not select.select([self.process.stdout], [], [], 1)[0]:
            if self.cpu_s() - begin > MOST_S * self.slow:
                self.process.kill()
                return None, self.ended(f"more than {MOST_S} s of processor time")
        line = self.process.stdout.readline()
        if not line:
            return None, self.ended("the program ended")
        if self.peak_mb() > MOST_MB * self.slow:
            self.process.kill()
            return None, self.ended(f"more than {MOST_MB} MB")
        return json.loads(line), None

    def ended(self, what):
        _, errors = self.process.communicate()
        self.start()
        return f"{what}: {errors.decode(errors='replace')[:2000]}"


def fault_of(reader, path, ending, data):
    path.write_bytes(data)
    answer, fault = reader.ask(path)
    if fault or "error" in answer or answer["warnings"]:
        return fault
    wanted = stated(ending, data)
    if wanted is None or ending not in COUNTERS or answer[wanted[0]] == wanted[1]:
        return None
    return f"{answer[wanted[0]]} {wanted[0]} are read without a warning, {wanted[1]} are stated"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("count", type=int)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keep", type=pathlib.Path)
    parser.add_argument("--state", type=pathlib.Path)
    arguments = parser.parse_args()
    files, reader = samples(), Reader(arguments.program.resolve())
    state = arguments.state
    first, faults = json.loads(state.read_text()) if state and state.exists() else (0, [])
    with tempfile.TemporaryDirectory() as folder:
        for i in range(first, arguments.count):
            chance = random.Random(1_000_000 * arguments.seed + i)
            ending, data = chance.choice(files)
            data = mutate(data, chance)
            fault = fault_of(reader, pathlib.Path(folder, "in" + ending), ending, data)
            if fault:
                faults.append(f"{ending}, {i}: {fault}")
                print(faults[-1], flush=True)
                if arguments.keep:
                    arguments.keep.mkdir(parents=True, exist_ok=True)
                    (arguments.keep / f"{i}{ending}").write_bytes(data)
            if state and (i % 50 == 49 or i + 1 == arguments.count):
                state.write_text(json.dumps([i + 1, faults]))
    print(f"{arguments.count} mutated files, {len(faults)} faults")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
