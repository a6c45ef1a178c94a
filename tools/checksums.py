#!/usr/bin/env python3
"""Checksums of twelve small scans: shows whether a change of the sources changes a byte of what is measured.

usage: checksums.py PROGRAM [--record | --compare] [--keep FOLDER] [SCAN ...]

Simulates the scans (a third of the cameras' pixels on a side, two to six views), decodes one view of each and
reconstructs or merges them. The SHA-256 of the mesh, of the maps and of the answers of --json, without times and
memory, go to the standard output; --record writes them to tools/checksums.txt, --compare names what differs from
it. Floating-point results depend on processor and libraries, so the file states the machine; on another one,
record with the program of the older commit first. All scans take below three minutes of processor time.
"""
import argparse
import hashlib
import json
import pathlib
import platform
import re
import resource
import shutil
import subprocess
import sys
import tempfile

RECORD = pathlib.Path(__file__).with_suffix(".txt")
REDUCED = 3
VOLATILE = ("seconds", "peak_memory_mb")


class Workshop:
    """The folder in which the scans are made; the program runs there, so that all paths it prints are relative."""

    def __init__(self, program, folder):
        self.program = program
        self.folder = folder

    def run(self, *arguments):
        """The answer of --json; a scan that is not trustworthy has one, too."""
        done = subprocess.run(
            [self.program, "--json", *map(str, arguments)], cwd=self.folder, capture_output=True, text=True
        )
        if done.returncode not in (0, 4, 5):
            sys.exit(f"{self.program} {' '.join(map(str, arguments))}: {done.stderr or done.stdout}")
        return json.loads(done.stdout)

    def rig(self, name):
        """A built-in rig with cameras of a third of the pixels on a side."""
        path = self.folder / f"{name}.toml"
        if not path.exists():
            self.run("simulate", "plate", "--rig", name, "--views", 1, "-o", f"full-{name}")
            path.write_text(reduced((self.folder / f"full-{name}" / "rig.toml").read_text()))
        return path.name

    def simulate(self, scan, part, rig, views, *options):
        self.run("simulate", part, "--rig", self.rig(rig), "--views", views, "-o", scan, *options)

    def append_patterns(self, scan, other, rename):
        """Adds the patterns and frames of another scan of the same views. `rename` maps names of its patterns; others
        are left out."""
        tables = (self.folder / other / "scan.toml").read_text()
        added = []
        for table in re.findall(r"\[\[pattern\]\].*?(?=\n\[|\Z)", tables, re.S):
            name = re.search(r'^name = "([^"]+)"', table, re.M)[1]
            if name not in rename:
                continue
            added.append(table.replace(f'name = "{name}"', f'name = "{rename[name]}"', 1))
            for frame in (self.folder / other / "views").rglob(f"{name}-*.png"):
                to = self.folder / scan / frame.relative_to(self.folder / other)
                shutil.copy(frame, to.with_name(frame.name.replace(name, rename[name], 1)))
        path = self.folder / scan / "scan.toml"
        head, separator, rest = path.read_text().partition("[[pattern]]")
        path.write_text(head + "\n\n".join(added) + "\n\n" + separator + rest)


def reduced(rig):
    """rig.toml with cameras of fewer pixels and the same field."""

    def table(match):
        def numbers(line):
            values = [float(value) for value in line[2].split(",")]
            if line[1] == "principal_point_px":
                values = [(value + 0.5) / REDUCED - 0.5 for value in values]
            else:
                values = [value / REDUCED for value in values]
            if line[1] == "size_px":
                values = [int(value) for value in values]
            return f"{line[1]} = {values}"

        return re.sub(r"(size_px|focal_px|principal_point_px) = \[([^\]]*)\]", numbers, match[0])

    return re.sub(r"^\[+(?:camera|more_cameras)\]+\n.*?(?=^\[|\Z)", table, rig, flags=re.M | re.S)


def digital(shop):
    shop.simulate("digital", "blade", "digital", 5)


def sheet(shop):
    shop.simulate("sheet", "bust", "angular", 6)


def two_maps_sheet(shop):
    shop.simulate("two-maps-sheet", "bust", "angular", 6)
    shop.simulate("coarse", "bust", "angular", 6, "--fringes-per-degree", 0.25)
    shop.append_patterns("two-maps-sheet", "coarse", {"fringe": "coarse"})


def gray(shop):
    shop.simulate("gray", "bracket", "digital", 4, "--sequence", "gray")


def gray_alone(shop):
    shop.simulate("gray-alone", "bracket", "digital", 4, "--sequence", "gray-alone")


def beats(shop):
    shop.simulate("beats", "bracket", "digital", 4, "--sequence", "heterodyne")


def both_directions(shop):
    shop.simulate("both-directions", "bracket", "digital", 4, "--periods", "1280,160,20")
    shop.simulate("rows", "bracket", "digital", 4, "--periods", "800,100,12.5", "--direction", "horizontal")
    shop.append_patterns("both-directions", "rows", {"p800": "r800", "p100": "r100", "p12.5": "r12.5"})


def two_cameras(shop):
    shop.simulate("two-cameras", "bracket", "binocular", 3)


def label(shop):
    shop.simulate("label", "bracket", "binocular", 3, "--label")


def groove(shop):
    shop.simulate("groove", "groove", "digital", 2, "--bounces", 1, "--albedo", 0.8, "--periods", "1280,160,40")


def two_setups(shop):
    shop.simulate("two-setups", "bracket", "digital", 4, "--setups", 90)


SCANS = {
    scan.__name__.replace("_", "-"): scan
    for scan in (
        digital,
        sheet,
        two_maps_sheet,
        gray,
        gray_alone,
        beats,
        both_directions,
        two_cameras,
        label,
        groove,
        two_setups,
    )
}


def merge(shop):
    """Three meshes, each of one view of a scan, and what merging makes of them. Returns the answer."""
    shop.simulate("for-merge", "bust", "digital", 6)
    text = (shop.folder / "for-merge" / "scan.toml").read_text()
    views = re.findall(r"\[\[view\]\].*?(?=\n\[|\Z)", text, re.S)
    head = text.partition("[[view]]")[0]
    for number, view in enumerate(views):
        (shop.folder / "for-merge" / "scan.toml").write_text(head + view + "\n")
        shop.run("reconstruct", "for-merge", "-o", f"view-{number}.ply")
    return shop.run("merge", *(f"view-{number}.ply" for number in range(len(views))), "-o", "merge.ply")


def sha(data):
    return hashlib.sha256(data).hexdigest()


def sha_of_answer(answer):
    def lasting(value):
        if isinstance(value, dict):
            return {key: lasting(one) for key, one in value.items() if key not in VOLATILE}
        return [lasting(one) for one in value] if isinstance(value, list) else value

    return sha(json.dumps(lasting(answer)).encode())


def checksums(shop, names):
    """`NAME WHAT SHA-256` of each scan."""
    for name in names:
        if name == "merge":
            answer = merge(shop)
        else:
            SCANS[name](shop)
            decoded = shop.run("decode", name, "--view", 0, "-o", f"{name}-maps")
            yield f"{name} decode-json {sha_of_answer(decoded)}"
            maps = sorted((shop.folder / f"{name}-maps").glob("*.tiff"))
            yield f"{name} maps {sha(b''.join(path.name.encode() + path.read_bytes() for path in maps))}"
            answer = shop.run("reconstruct", name, "-o", f"{name}.ply")
        yield f"{name} json {sha_of_answer(answer)}"
        yield f"{name} mesh {sha((shop.folder / f'{name}.ply').read_bytes())}"


def machine():
    cpu = re.search(r"^model name\s*:\s*(.*)$", pathlib.Path("/proc/cpuinfo").read_text(), re.M)
    system = re.search(r'^PRETTY_NAME="(.*)"$', pathlib.Path("/etc/os-release").read_text(), re.M)
    return f"{cpu[1] if cpu else platform.machine()}, {system[1] if system else platform.system()}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=lambda path: pathlib.Path(path).resolve(strict=True))
    action = parser.add_mutually_exclusive_group()
    action.add_argument("--record", action="store_true", help="write tools/checksums.txt")
    action.add_argument("--compare", action="store_true", help="name what differs from tools/checksums.txt")
    parser.add_argument("--keep", type=pathlib.Path, metavar="FOLDER", help="a new folder for scans and results")
    parser.add_argument("scans", nargs="*", metavar="SCAN", help=f"all by default: {', '.join([*SCANS, 'merge'])}")
    arguments = parser.parse_intermixed_args()
    names = arguments.scans or [*SCANS, "merge"]
    if unknown := [name for name in names if name not in SCANS and name != "merge"]:
        parser.error(f"there is no scan {', '.join(unknown)}; choose from {', '.join([*SCANS, 'merge'])}")
    recorded = {}
    if arguments.compare:
        lines = RECORD.read_text().splitlines()
        print(f"recorded on: {lines[0][2:]}\nthis is:     {machine()}", file=sys.stderr)
        recorded = {tuple(line.split()[:2]): line.split()[2] for line in lines if not line.startswith("#")}

    folder = arguments.keep or pathlib.Path(tempfile.mkdtemp())
    folder.mkdir(exist_ok=True)
    found = []
    try:
        for line in checksums(Workshop(arguments.program, folder), names):
            name, what, digest = line.split()
            same = not arguments.compare or recorded.get((name, what)) == digest
            print(line if same else f"{line}  DIFFERS", flush=True)
            found.append((line, same))
    finally:
        if not arguments.keep:
            shutil.rmtree(folder)
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    print(f"{used.ru_utime + used.ru_stime:.0f} s of processor time", file=sys.stderr)
    if arguments.record:
        RECORD.write_text("\n".join([f"# {machine()}", *(line for line, _ in found), ""]))
    return 0 if all(same for _, same in found) else 1


if __name__ == "__main__":
    sys.exit(main())
