"""Shared by the sections of the figures: the program, a folder of scans that an interruption leaves intact, and lines of Markdown."""
import hashlib
import json
import pathlib
import shutil
import subprocess

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
SHARED = ROOT.parent / "shared" / "scans"


class NotMeasured(Exception):
    """Something that a section needs is missing on this machine; its page stays as it is."""


class Study:
    """What one section measures with, and the lines that it has written.

    Scans lie in out/figures/CHECKSUM/NAME, where the checksum is that of the program: a section that is
    started again goes on with the scans that are complete, and a new build measures everything again.
    """

    def __init__(self, program):
        self.program = pathlib.Path(program).resolve()
        self.tests = self.program.parent.parent / "tests"
        checksum = hashlib.sha256(self.program.read_bytes()).hexdigest()[:12]
        kept = ROOT / "out" / "figures"
        self.work = kept / checksum
        for other in kept.glob("*"):
            if other != self.work and other.is_dir():
                shutil.rmtree(other)
        self.work.mkdir(parents=True, exist_ok=True)
        self.lines = []

    def add(self, text=""):
        """A line of the section, printed at once."""
        print(text, flush=True)
        self.lines.append(text)

    def table(self, *columns):
        """The head of a table."""
        self.add("| " + " | ".join(columns) + " |\n" + "|---" * len(columns) + "|")

    def row(self, *cells):
        self.add("| " + " | ".join(map(str, cells)) + " |")

    def run(self, *arguments):
        """The JSON answer of the program."""
        result = subprocess.run(
            [self.program, "--json", *map(str, arguments)], check=True, capture_output=True, text=True
        )
        return json.loads(result.stdout)

    def made(self, name, *arguments):
        """A folder or file that the program writes with `-o`, made once: arguments, then `-o PATH`."""
        path = self.work / name
        if not path.exists():
            unfinished = path.with_name("unfinished-" + name)
            if unfinished.is_dir():
                shutil.rmtree(unfinished)
            self.run(*arguments, "-o", unfinished)
            unfinished.rename(path)
        return path

    def simulated(self, part, rig="digital", name=None, *options):
        """The scan of a part by a simulated rig, made once."""
        return self.made(name or f"{part}-{rig}", "simulate", part, "--rig", rig, "--samples", 4, *options)

    def captured(self, name, rig, *options):
        """The scan that simulated devices capture, made once; an interrupted capture goes on."""
        path = self.work / name
        if not path.exists():
            unfinished = path.with_name("unfinished-" + name)
            self.run("scan", rig, *options, "-o", unfinished)
            unfinished.rename(path)
        return path

    def run_in_new_folder(self, name, *arguments):
        """The JSON answer of a command that writes a folder; deletes the folder of an earlier call."""
        shutil.rmtree(self.work / name, ignore_errors=True)
        return self.run(*arguments, "-o", self.work / name)

    def inspected(self, scan, truth):
        """The comparison of a scan's mesh with the true surface."""
        mesh = self.work / "inspected.ply"
        self.run("reconstruct", scan, "-o", mesh)
        return self.run("inspect", mesh, "--reference", truth, "--scan", scan)

    def build(self, *targets):
        """Builds what the section needs in addition to the program."""
        subprocess.run(
            ["cmake", "--preset", "release", "-DFRANGIA_BENCHMARKS=ON"], check=True, cwd=ROOT, stdout=subprocess.DEVNULL
        )
        subprocess.run(["cmake", "--build", "--preset", "release", "--target", *targets], check=True, cwd=ROOT)

    def tested(self, program, test):
        """The JSON that a test prints after the word FIGURE."""
        result = subprocess.run(
            [self.tests / program, f"--gtest_filter={test}"], check=True, capture_output=True, text=True
        )
        line = next(line for line in result.stdout.splitlines() if line.startswith("FIGURE "))
        return json.loads(line[len("FIGURE ") :])

    def shared(self, name):
        """A scan of ../shared/scans."""
        if not (SHARED / name).exists():
            raise NotMeasured(f"{SHARED / name} does not exist")
        return SHARED / name


def seconds(answer):
    return ", ".join(f"{stage} {time:.2f}" for stage, time in answer["seconds"].items())
