"""What the studies share: the program, a small rig, the result of an undisturbed scan, and their answers."""
import contextlib
import dataclasses
import hashlib
import json
import os
import pathlib
import random
import shutil
import subprocess
import time
import zlib

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
RIG = ROOT / "tests" / "data" / "small-interferometer.toml"


@dataclasses.dataclass
class Answer:
    """The result of one study: how much was tried and what of it failed."""

    name: str  # the file of the study
    title: str  # what was done, for the table
    tried: int
    failures: list = dataclasses.field(default_factory=list)  # one sentence each
    measured: str = ""  # further figures


class Progress:
    """The trials of a long study, which goes on where it was stopped: out/faults/STUDY.json holds what was tried of the same
    program, seed and number of trials. A trial depends on its number alone, see `chance`."""

    def __init__(self, path, key, answer):
        self.path, self.key, self.answer = path, key, answer
        self.done = 0
        if path and path.exists():
            with contextlib.suppress(ValueError, KeyError):
                found = json.loads(path.read_text())
                if found["key"] == key:
                    self.done = found["done"]
                    answer.failures.extend(found["failures"])

    def rest(self):
        """The numbers of the trials that are left; what is before the present one is recorded."""
        for number in range(self.done, self.answer.tried):
            yield number
            self._save(number + 1)
        if self.path:
            self.path.unlink(missing_ok=True)

    def blocks(self, size):
        """The same, several trials at a time, which may be tried at once: what is before a block is recorded."""
        while self.done < self.answer.tried:
            block = range(self.done, min(self.done + size, self.answer.tried))
            yield block
            self.done = block.stop
            self._save(self.done)
        if self.path:
            self.path.unlink(missing_ok=True)

    def chance(self, number):
        """Random choices of one trial."""
        return random.Random(f"{self.key.split()[1]} {number}")

    def _save(self, done):
        if not self.path:
            return
        self.path.parent.mkdir(parents=True, exist_ok=True)
        temporary = self.path.with_suffix(".tmp")
        temporary.write_text(json.dumps({"key": self.key, "done": done, "failures": self.answer.failures}))
        os.replace(temporary, self.path)


class Campaign:
    """One run: `count(short, long)` chooses how much is tried."""

    def __init__(self, program, work, is_long, seed, asan=None):
        self.program = pathlib.Path(program).resolve()
        self.asan = asan and asan.resolve()  # the same program with sanitizers
        self.seed = seed
        self.work = pathlib.Path(work)
        self.is_long = is_long
        self.random = random.Random(seed)
        self.views = "3"
        self._whole = None

    def count(self, short, long):
        return long if self.is_long else short

    def progress(self, answer, program=None):
        """The progress of a study with this program, or with another one."""
        digest = hashlib.sha256((program or self.program).read_bytes()).hexdigest()[:16]
        path = ROOT / "out" / "faults" / f"{answer.name}.json" if self.is_long else None
        return Progress(path, f"{digest} {self.seed} {answer.tried}", answer)

    def latency(self, seconds):
        """The limit of a latency: in the short run, beside other tests, only that it ends."""
        return seconds if self.is_long else 60.0

    def fresh(self, name):
        """A path that does not exist, below the campaign's folder."""
        folder = self.work / f"{name}-{self.random.getrandbits(40):010x}"
        folder.mkdir(parents=True)
        return folder / "scan"

    def scan_command(self, scan, rig=RIG):
        return [self.program, "--quiet", "scan", rig, "--views", self.views, "-o", scan]

    def digest(self, scan):
        """A hash of all frames and of the mesh, for which the times of the frames do not count: they differ."""
        mesh, timeless = scan.parent / "mesh.ply", scan.parent / "timeless"
        shutil.copytree(scan, timeless, ignore=shutil.ignore_patterns("capture"))
        subprocess.run(
            [self.program, "--quiet", "reconstruct", timeless, "-o", mesh], check=True, stderr=subprocess.DEVNULL
        )
        shutil.rmtree(timeless)
        found = hashlib.sha256(mesh.read_bytes())
        for frame in sorted(scan.rglob("*.png")):
            found.update(str(frame.relative_to(scan)).encode() + frame.read_bytes())
        return found.hexdigest()

    def whole(self):
        """Digest and seconds of a scan that nothing disturbs."""
        if self._whole is None:
            scan = self.fresh("whole")
            begin = time.monotonic()
            subprocess.run(self.scan_command(scan), check=True)
            seconds = time.monotonic() - begin
            self._whole = self.digest(scan), seconds
        return self._whole

    def finish(self, scan, answer, what):
        """Repeats the command until the scan is complete, and compares it with the undisturbed one."""
        for _ in range(4):
            result = subprocess.run(self.scan_command(scan), capture_output=True, text=True, timeout=120)
            if result.returncode == 0:
                break
        else:
            answer.failures.append(f"{what}: the scan cannot be finished: {result.stderr.strip()}")
            return
        if self.digest(scan) != self.whole()[0]:
            answer.failures.append(f"{what}: a frame or the mesh differs from those of an undisturbed scan")


def acknowledged_frames(scan):
    """The frames that the manifest lists, with their checksums."""
    manifest = scan / "capture" / "manifest.txt"
    if not manifest.exists():
        return []
    lines = manifest.read_bytes().decode("latin-1").splitlines(keepends=True)
    words = [line.split() for line in lines if line.startswith("frame ") and line.endswith("\n")]
    return [(line[1], int(line[2], 16)) for line in words]


def count_lost(scan, frames=None):
    """The number of acknowledged frames that are missing or changed."""
    lost = 0
    for name, checksum in acknowledged_frames(scan) if frames is None else frames:
        frame = scan / name
        lost += not frame.exists() or zlib.crc32(frame.read_bytes()) != checksum
    return lost
