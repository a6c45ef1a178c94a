"""What a case of a section measures with: the program, shared scans and a folder."""
import functools
import json
import pathlib
import shutil
import subprocess

from half_rig import halved
from inputs import ROOT, SHARED
from scans import Scans


class NotMeasured(Exception):
    """Something that a section needs is missing on this machine; its page stays as it is."""


class NotAsWanted(Exception):
    """A result is worse than wanted; the page stays as it is, and the program ends with 1."""


class Study:
    """The program for one section, which runs no verb but those that the section's inputs state.

    `work` is a folder for the section's own files, which begins empty.
    """

    def __init__(self, program, name, inputs):
        self.program = pathlib.Path(program).resolve()
        self.tests = self.program.parent.parent / "tests"
        self.name, self.verbs = name, inputs.verbs.split()
        self.scans = Scans(self.program)
        self.work = ROOT / "out" / "figures" / "work" / name
        shutil.rmtree(self.work, ignore_errors=True)
        self.work.mkdir(parents=True)

    def check_verb(self, verb):
        if verb not in self.verbs:
            raise SystemExit(
                f"figures: section {self.name} runs `frangia {verb}`: state it in tools/figures/table.py, or changes of it go unnoticed"
            )

    def process(self, *arguments, allowed=(0,), **options):
        """The finished process of the program, with what it printed; CalledProcessError for another exit code than those allowed."""
        words = [str(word) for word in arguments]
        self.check_verb(next(word for word in words if not word.startswith("-")))
        run = subprocess.run([self.program, *words], capture_output=True, text=True, **options)
        if allowed and run.returncode not in allowed:
            raise subprocess.CalledProcessError(run.returncode, run.args, run.stdout, run.stderr)
        return run

    def run(self, *arguments, allowed=(0,)):
        """The JSON answer of the program."""
        return json.loads(self.process("--json", *arguments, allowed=allowed).stdout)

    def simulated(self, *arguments):
        """The scan that `frangia simulate ARGUMENTS` renders, shared by all sections: nobody changes it."""
        self.check_verb("simulate")
        return self.scans.made("simulate", *arguments)

    def digital(self, part, rig="digital", *options):
        """The scan of a part with four rays a pixel."""
        return self.simulated(part, "--rig", rig, "--samples", 4, *options)

    def captured(self, rig, *options):
        """The scan that simulated devices capture, shared like rendered ones, and the answer of the program."""
        self.check_verb("scan")
        scan = self.scans.made("scan", rig, *options)
        return scan, self.scans.answer(scan)

    @functools.cached_property
    def half_rig(self):
        """The digital rig with half the pixels of its camera on a side, as a file."""
        rig = self.work / "digital-half.toml"
        rig.write_text(halved((self.simulated("plate", "--rig", "digital", "--views", 1) / "rig.toml").read_text()))
        return rig

    def fresh(self, name):
        """The path of a file or folder in `work` that does not exist."""
        path = self.work / name
        if path.is_dir():
            shutil.rmtree(path)
        path.unlink(missing_ok=True)
        return path

    def reconstructed(self, scan, *options):
        """The mesh of a scan, replaced by the next one, and the answer of the program."""
        mesh = self.work / "mesh.ply"
        return mesh, self.run("reconstruct", scan, "-o", mesh, *options)

    def inspected(self, scan, truth):
        """The comparison of a scan's mesh with the true surface."""
        mesh, _ = self.reconstructed(scan)
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
