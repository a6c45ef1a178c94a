#!/usr/bin/env python3
"""Runs the program on mutated input files and reports every crash, hang and excess of memory.

    mutate_inputs.py PROGRAM COUNT [--seed N] [--keep FOLDER] [--jobs N]

Each input is a sample file of one format with one to four mutations: flipped bits, a truncation, a
splice, a repeated part, or a number that is replaced by an extreme one. The verb that reads the
format runs on it with 2 GB of memory and 5 s of processor time. The program must end with an exit code of its own
(0, 1, 2, 3, 4 or 5) and must print no control characters. Samples are the kept inputs of the
fuzzers and files that the program writes itself. The last line counts the runs and the faults; the
exit code is 1 when there is a fault. A faulty input is kept in FOLDER with the command and the end
of its output.
"""
import argparse
import concurrent.futures
import os
import pathlib
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
SEEDS = REPOSITORY / "fuzz" / "seeds"
CALIBRATIONS = REPOSITORY / "tests" / "exchange" / "data"
SMALL_RIG = REPOSITORY / "tests" / "data" / "small-interferometer.toml"
MAX_BYTES = 2_000_000_000
SLOWDOWN = float(os.environ.get("FRANGIA_SLOWDOWN", "1"))  # of programs with sanitizers
MAX_SECONDS = round(5 * SLOWDOWN)  # of processor time
PATIENCE = 120 * SLOWDOWN  # for a program that waits
EXIT_CODES = {0, 1, 2, 3, 4, 5}
MESHES = ["3mf", "dxf", "glb", "gltf", "obj", "off", "pcd", "ply", "stl", "xyz"]
NUMBERS = [
    b"-1",
    b"0",
    b"1e300",
    b"-1e300",
    b"nan",
    b"inf",
    b"0.5",
    b"4294967296",
    b"2147483648",
    b"9223372036854775807",
    b"18446744073709551615",
    b"9000000000000000000",
    b"1e-300",
]


class Case:
    """A sample file and the commands that read it."""

    def __init__(self, name, sample, place, commands, folder=None, is_finite=False):
        self.name = name  # for the report
        self.sample = sample  # bytes
        self.place = place  # path of the file, relative to the folder of the run
        self.commands = commands  # lists of arguments
        self.folder = folder  # files that the folder of the run also holds
        self.is_finite = is_finite  # no result may be NaN


def flip_bits(data, chance):
    data = bytearray(data)
    for _ in range(chance.choice([1, 1, 2, 8])):
        if data:
            data[chance.randrange(len(data))] ^= 1 << chance.randrange(8)
    return bytes(data)


def truncate(data, chance):
    return data[: chance.randrange(len(data) + 1)]


def splice(data, chance):
    begin, end = sorted(chance.randrange(len(data) + 1) for _ in range(2))
    at = chance.randrange(len(data) + 1)
    return data[:at] + data[begin:end] + data[at:]


def repeat(data, chance):
    begin = chance.randrange(len(data) + 1)
    part = data[begin : begin + chance.choice([1, 4, 16, 64])]
    return data[:begin] + part * chance.choice([10, 1000, 20000]) + data[begin:]


def swap_number(data, chance):
    numbers = list(re.finditer(rb"-?\d+(\.\d+)?", data))
    if not numbers:
        return flip_bits(data, chance)
    found = chance.choice(numbers)
    return data[: found.start()] + chance.choice(NUMBERS) + data[found.end() :]


def swap_word(data, chance):
    """Replaces four aligned bytes, as a binary count or index."""
    if len(data) < 8:
        return flip_bits(data, chance)
    at = 4 * chance.randrange(len(data) // 4)
    word = chance.choice([b"\xff" * 4, b"\0" * 4, b"\xff\xff\xff\x7f", b"\0\0\0\x80", b"\0\0\x80\x7f"])
    return data[:at] + word + data[at + 4 :]


def insert_odd_text(data, chance):
    at = chance.randrange(len(data) + 1)
    odd = chance.choice([b"\x1b[31m", b"\xff\xfe", b"\0", b"\xe2\x80\xae", b"\r\n\n", b"%s%n", b'"'])
    return data[:at] + odd + data[at:]


MUTATIONS = [flip_bits, flip_bits, truncate, splice, repeat, swap_number, swap_number, swap_word, insert_odd_text]


def mutate(data, chance):
    for _ in range(chance.choice([1, 1, 2, 4])):
        data = chance.choice(MUTATIONS)(data, chance)
    return data[:9_000_000]


def sheet_ply(side):
    """A wavy sheet of side x side points as an ascii PLY."""
    header = (
        "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
        "element face {}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    points = [f"{x} {y} {x * y % 7 / 10}\n" for y in range(side) for x in range(side)]
    corners = [y * side + x for y in range(side - 1) for x in range(side - 1)]
    faces = [f"3 {i} {i + 1} {i + side}\n3 {i + 1} {i + side + 1} {i + side}\n" for i in corners]
    return header.format(len(points), 2 * len(faces)) + "".join(points) + "".join(faces)


def sample_files(program, folder):
    """Meshes of every format and a scan, written by the program."""

    def run(*arguments):
        subprocess.run([program, "--quiet", *arguments], check=True, stdout=subprocess.DEVNULL)

    run("simulate", "plate", "--rig", str(SMALL_RIG), "--views", "2", "-o", str(folder / "scan"))
    (folder / "scan" / "truth.ply").unlink()
    (folder / "a.ply").write_text(sheet_ply(12))
    outputs = [argument for kind in MESHES if kind != "ply" for argument in ("-o", str(folder / f"a.{kind}"))]
    run("edit", str(folder / "a.ply"), *outputs)


def all_cases(program, folder):
    sample_files(program, folder)
    cases = []
    mesh_commands = [
        ["edit", "FILE", "--list"],
        ["edit", "FILE", "--fill-holes", "10", "--orient", "-o", "out.stl"],
        ["inspect", "FILE", "--reference", "FILE"],
    ]
    for kind in MESHES:
        files = [folder / f"a.{kind}", *sorted((SEEDS / kind).iterdir())]
        cases += [Case(kind, file.read_bytes(), f"in.{kind}", mesh_commands) for file in files]
    scan = folder / "scan"
    frame = sorted(scan.glob("views/000/*.png"))[0]
    for name in ["scan.toml", "rig.toml", str(frame.relative_to(scan))]:
        commands = [["decode", "scan", "--view", "0", "-o", "stages"], ["reconstruct", "scan", "-o", "out.stl"]]
        cases.append(
            Case(
                name.split(".")[-1] if name.endswith("png") else name,
                (scan / name).read_bytes(),
                "scan/" + name,
                commands,
                scan,
            )
        )
    merge = ["merge", "FILE", "-o", "out.stl"]
    for file in sorted((SEEDS / "range").iterdir()):
        cases.append(Case("range", file.read_bytes(), "in.ply", [merge, ["merge", "FILE", "FILE", "-o", "out.stl"]]))
    cases.append(Case("range", (folder / "a.ply").read_bytes(), "in.ply", [merge]))
    conf = b"bmesh a.ply 1 2 3 0 0 0.70710678 0.70710678\nbmesh a.ply 0 0 0 0 0 0 1\n"
    cases.append(Case("conf", conf, "in.conf", [merge], folder / "a.ply"))
    script = b"""{"format": "frangia-edits", "version": 1, "done": 2, "steps": [
 {"operation": "fill-holes", "value": "10mm"}, {"operation": "orient"}, {"operation": "decimate", "value": "50"}]}"""
    cases.append(
        Case("script", script, "in.json", [["edit", "a.ply", "--script", "FILE", "-o", "out.stl"]], folder / "a.ply")
    )
    cases.append(
        Case(
            "rig",
            SMALL_RIG.read_bytes(),
            "in.toml",
            [
                ["plan", "--rig", "FILE"],
                ["devices", "FILE", "--no-search"],
                ["simulate", "plate", "--rig", "FILE", "--views", "1", "-o", "out"],
            ],
        )
    )
    manifest = (SEEDS / "manifest" / "capture.txt").read_bytes()
    cases.append(
        Case("manifest", manifest, "scan/capture/manifest.txt", [["reconstruct", "scan", "-o", "out.stl"]], scan)
    )
    foreign = [
        "calibrate",
        "import",
        "FILE",
        "--camera-size",
        "1280,1024",
        "--projector-size",
        "1280,800",
        "-o",
        "rig.toml",
    ]
    for file in sorted(CALIBRATIONS.iterdir()):
        cases.append(Case("calibration", file.read_bytes(), "in" + file.suffix, [foreign]))
    return cases


def limit():
    if SLOWDOWN == 1:  # a sanitizer reserves more than it uses
        resource.setrlimit(resource.RLIMIT_DATA, (MAX_BYTES, MAX_BYTES))
    resource.setrlimit(resource.RLIMIT_CPU, (MAX_SECONDS, MAX_SECONDS + 5))  # SIGXCPU
    resource.setrlimit(resource.RLIMIT_FSIZE, (500_000_000, 500_000_000))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def is_plain(output):
    try:
        text = output.decode()
    except UnicodeDecodeError:
        return False
    return not any(ord(c) < 32 and c != "\n" or 127 <= ord(c) < 160 or c in "\u202a\u202b\u202d\u202e" for c in text)


def sanitizer_options(reports):
    """The environment in which a report of a sanitizer is a crash: otherwise it ends with exit code 1, as a refusal does.
    What is still allocated at the end of a program is no fault. A process that the program starts has no output: each
    report is a file whose name begins with `reports`."""
    options = f"abort_on_error=1:detect_leaks=0:log_path={reports}"
    return {**os.environ, "ASAN_OPTIONS": options, "UBSAN_OPTIONS": f"{options}:print_stacktrace=1"}


def is_ours(report):
    """Whether a report of a sanitizer is about our code; libraries of others may fail in a process of their own."""
    frames = re.findall(r"#\d+ \S+ in (\S+)", report)
    callers = [name for name in frames if not name.startswith(("__", "operator")) and "interceptor" not in name]
    return "runtime error" in report or not callers or "frangia" in callers[0]


def fault_of(program, command, folder):
    """What is wrong with a run; None when nothing is."""
    with tempfile.TemporaryDirectory(prefix="frangia-reports-") as name:
        what, output = ending_of(program, command, folder, sanitizer_options(pathlib.Path(name) / "report"))
        reports = [file.read_text(errors="replace") for file in sorted(pathlib.Path(name).iterdir())]
    if what is None and any(is_ours(report) for report in reports):
        what = "a sanitizer reports a process that it started"
    return what, output + "".join(reports).encode()


def ending_of(program, command, folder, environment):
    """What is wrong with how a run ends, and its output."""
    process = subprocess.Popen(
        [program, *command],
        cwd=folder,
        env=environment,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        preexec_fn=limit,
    )
    try:
        output, _ = process.communicate(timeout=PATIENCE)
    except subprocess.TimeoutExpired:
        process.kill()
        output, _ = process.communicate()
        return f"still running after {PATIENCE} s", output
    code = process.returncode
    if code == -signal.SIGXCPU:
        return f"more than {MAX_SECONDS} s of processor time", output
    if code < 0:
        return f"ended by {signal.Signals(-code).name}", output
    if b"does not fit into the memory" in output:
        return f"more than {MAX_BYTES / 1e9:g} GB", output
    if code not in EXIT_CODES:
        return f"exit code {code}", output
    if not is_plain(output):
        return "control characters in the output", output
    return None, output


def run_one(program, case, seed, keep):
    chance = random.Random(seed)
    data = mutate(case.sample, chance)
    command = chance.choice(case.commands)
    with tempfile.TemporaryDirectory(prefix="frangia-mutate-") as name:
        folder = pathlib.Path(name)
        if case.folder is not None and case.folder.is_dir():
            shutil.copytree(case.folder, folder / case.folder.name)
        elif case.folder is not None:
            shutil.copy(case.folder, folder)
        place = folder / case.place
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_bytes(data)
        words = [case.place if word == "FILE" else word for word in command]
        what, output = fault_of(program, words, folder)
    if what is None and case.is_finite and re.search(rb"\bnan\b", output.lower()):
        what = "a result that is no number"
    if what is None:
        return None
    if keep:
        keep.mkdir(parents=True, exist_ok=True)
        (keep / f"{seed}-{case.place.replace('/', '-')}").write_bytes(data)
        (keep / f"{seed}.txt").write_bytes(f"{' '.join(words)}\n{what}\n".encode() + output[-2000:])
    return f"{case.name}, seed {seed}: {what}: frangia {' '.join(words)}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("count", type=int)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keep", type=pathlib.Path)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    arguments = parser.parse_args()
    program = str(arguments.program.resolve())
    with tempfile.TemporaryDirectory(prefix="frangia-samples-") as name:
        cases = all_cases(program, pathlib.Path(name))
        chance = random.Random(arguments.seed)
        runs = [(chance.choice(cases), arguments.seed * 1_000_000 + i) for i in range(arguments.count)]
        with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
            faults = [fault for fault in pool.map(lambda run: run_one(program, *run, arguments.keep), runs) if fault]
    for fault in faults:
        print(fault)
    print(f"{arguments.count} mutated inputs, {len(faults)} faults")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
