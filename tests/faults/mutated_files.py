"""Mutated CAD, .mat, JSON and project files: no crash, no hang, no unbounded memory, no number that is none.

With `--asan PROGRAM`, a program built with sanitizers reads the files, without limits of memory.
"""
import concurrent.futures
import contextlib
import os
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile

import mutate_inputs
from campaign import ROOT, Answer
from mutate_inputs import CALIBRATIONS, SMALL_RIG, Case, mutate, sheet_ply

CAD = ROOT / "tests" / "data" / "cad-samples"  # small and sound: thousands are read, each by a program of its own
STEP_S = 3  # processor time of a CAD file
MOST_GROWTH_MB = 256
BLOCK = 40  # trials between two records of what is done
KINDS = ["cad", "mat", "json", "project"]


def commands_cases(folder):
    """For each kind that a verb reads: the samples and the commands."""
    (folder / "a.ply").write_text(sheet_ply(12))
    inspect = ["--json", "inspect", "a.ply", "--reference", "FILE", "--align", "none", "--allow-time", str(STEP_S)]
    cad = [
        Case("cad", file.read_bytes(), "in" + file.suffix, [inspect], folder / "a.ply", is_finite=True)
        for file in sorted(CAD.iterdir())
    ]
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
    calibrations = [
        Case(file.suffix[1:], file.read_bytes(), "in" + file.suffix, [foreign])
        for file in sorted(CALIBRATIONS.iterdir())
        if file.suffix in (".mat", ".json")
    ]
    script = b"""{"format": "frangia-edits", "version": 1, "done": 2, "steps": [
 {"operation": "fill-holes", "value": "10mm"}, {"operation": "orient"}, {"operation": "decimate", "value": "50"}]}"""
    edits = [
        Case("json", script, "in.json", [["edit", "a.ply", "--script", "FILE", "-o", "out.stl"]], folder / "a.ply")
    ]
    return {
        "cad": cad,
        "mat": [case for case in calibrations if case.name == "mat"],
        "json": [case for case in calibrations if case.name == "json"] + edits,
    }


def batch_case(program, folder):
    """The record of a batch, which is read to see what is done."""
    scans = folder / "batch" / "scans"
    subprocess.run(
        [program, "--quiet", "simulate", "plate", "--rig", SMALL_RIG, "--views", "3", "-o", scans / "a"], check=True
    )
    subprocess.run([program, "--quiet", "batch", "scans", "-o", "meshes"], check=True, cwd=scans.parent)
    mark = scans.parent / "meshes" / "a" / "done.json"
    return Case(
        "json",
        mark.read_bytes(),
        "batch/meshes/a/done.json",
        [["batch", "batch/scans", "-o", "batch/meshes", "--table"]],
        scans.parent,
    )


class Projects:
    """A server that opens one mutated project after the other."""

    def __init__(self, program, folder, with_limits):
        sys.path.insert(0, str(ROOT / "tests" / "app"))
        import serve_client

        serve_client.PROGRAM = str(program)
        self.client, self.folder, self.with_limits = serve_client, folder, with_limits
        self.count, self.server, self.sample = 0, None, None
        self.start()
        self.server.command("create-project", name="sample", part="plate", stations=2)
        self.server.wait()
        self.server.coarsen_camera("sample", 4)  # each of thousands of projects is opened with its surface
        for command in ["start-scan", "reconstruct"]:
            self.server.command(command)
            self.server.wait()
        self.sample, self.base_mb = self.server.projects / "sample", self.memory_mb()
        self.files = sorted(
            path.relative_to(self.sample)
            for path in self.sample.rglob("*")
            if path.suffix in (".json", ".toml") and path.is_file()
        )

    def start(self):
        runtime = self.folder / f"server-{self.count}"
        runtime.mkdir()
        self.server = self.client.Server(runtime, projects=self.folder / "projects", stderr=subprocess.DEVNULL)
        self.server.login()
        if self.sample:
            self.server.command("open-project", name="sample")
            self.server.wait()
        self.base_mb = self.memory_mb()

    def memory_mb(self):
        status = pathlib.Path(f"/proc/{self.server.process.pid}/status").read_text()
        return next(int(line.split()[1]) for line in status.splitlines() if line.startswith("VmHWM")) / 1024

    def fault_of(self, data, file):
        """What is wrong after a project is opened in which `file` holds `data`."""
        self.count += 1
        name = f"mutated-{self.count}"
        project = self.server.projects / name
        shutil.copytree(self.sample, project, copy_function=os.link)
        (project / file).unlink()
        (project / file).write_bytes(data)
        what = None
        try:
            self.server.ask("POST", "/api/commands/open-project", {"name": name})
            self.server.wait()
            status = self.server.ask("GET", "/api/mesh")[0]
            if status == 0:
                what = "no answer"
        except (RuntimeError, OSError, ValueError) as error:
            what = f"no answer: {error}"
        if self.server.process.poll() is not None:
            what = f"the server ended with {self.server.process.returncode}"
        elif what is None and self.with_limits and self.memory_mb() > self.base_mb + MOST_GROWTH_MB:
            what = f"the server took {self.memory_mb() - self.base_mb:.0f} MB more"
        if what:
            self.stop()
            self.start()
        else:
            self.server.ask("POST", "/api/commands/close-project", {})
            shutil.rmtree(project)
        return what

    def stop(self):
        with contextlib.suppress(OSError, RuntimeError):
            if self.server.process.poll() is None:
                self.server.stop()


def reading_fault(program, case, seed, keep):
    """As mutate_inputs, and a result that is no number."""
    return mutate_inputs.run_one(program, case, seed, keep)


def run(campaign):
    program = campaign.asan or campaign.program
    answer = Answer(
        "mutated_files",
        "mutated CAD, .mat, JSON and project files, read by the verbs and a server"
        + (", with sanitizers" if campaign.asan else ""),
        campaign.count(60, 10000),
    )
    progress = campaign.progress(answer, program)
    failures = answer.failures
    if campaign.asan:
        mutate_inputs.SLOWDOWN = max(mutate_inputs.SLOWDOWN, 4.0)
        mutate_inputs.MAX_SECONDS = 5 * mutate_inputs.SLOWDOWN
    with tempfile.TemporaryDirectory(prefix="frangia-mutated-") as name:
        folder = pathlib.Path(name)
        cases = commands_cases(folder)
        cases["json"].append(batch_case(program, folder))
        projects = Projects(program, folder, mutate_inputs.SLOWDOWN == 1)

        def fault_of(number):
            seed = campaign.seed * 1_000_000 + number
            chance = random.Random(seed)
            kind = KINDS[number % len(KINDS)]
            if kind != "project":
                return reading_fault(program, chance.choice(cases[kind]), seed, campaign.work / "found")
            file = chance.choice(projects.files)
            what = projects.fault_of(mutate((projects.sample / file).read_bytes(), chance), file)
            return what and f"project, {file}, seed {seed}: {what}"

        # One server opens the projects, one after the other, while the verbs read the files.
        workers = concurrent.futures.ThreadPoolExecutor(os.cpu_count() if campaign.is_long else 1)
        try:
            for block in progress.blocks(BLOCK):
                files = [workers.submit(fault_of, i) for i in block if KINDS[i % len(KINDS)] != "project"]
                found = [fault_of(i) for i in block if KINDS[i % len(KINDS)] == "project"]
                found += [future.result() for future in files]
                failures.extend(fault for fault in found if fault)
        finally:
            workers.shutdown(cancel_futures=True)
            projects.stop()
    answer.measured = f"{answer.tried} mutated inputs, {len(failures)} faults"
    return answer
