"""`batch` is killed, or a write, sync or rename of it or its steps fails: what counts as done has its meshes, and the rest can be done."""
import hashlib
import json
import shutil
import subprocess
import time

from campaign import ROOT, Answer

CALLS = {"write,writev": 60, "fsync": 12, "fdatasync": 4, "rename": 12, "mkdir": 3}
PATIENCE_S = 120  # for a step that outlives its batch


class Batch:
    """Two scans, and what an undisturbed batch makes of them."""

    names = ["a", "b"]

    def __init__(self, campaign, answer):
        self.program, self.answer = campaign.program, answer
        self.folder = campaign.fresh("batch").parent
        rig = ROOT / "examples" / "python" / "small-rig.toml"
        for i, name in enumerate(self.names):
            scan = self.folder / "scans" / name
            subprocess.run(
                [self.program, "--quiet", "simulate", "plate", "--rig", rig, "--views", str(3 + i), "-o", scan],
                check=True,
            )
        begin = time.monotonic()
        subprocess.run(self.command("whole"), cwd=self.folder, check=True)
        self.seconds = time.monotonic() - begin
        self.whole = self.digests("whole")

    def command(self, out, *more):
        return [self.program, "--quiet", "batch", "scans", "-o", self.folder / out, *more]

    def digests(self, out):
        """The hash of each mesh that counts as done."""
        found = {}
        for name in self.names:
            mark = self.folder / out / name / "done.json"
            if mark.exists() and json.loads(mark.read_text())["row"]["state"] == "done":
                mesh = mark.with_name("mesh.ply")
                found[name] = hashlib.sha256(mesh.read_bytes()).hexdigest() if mesh.exists() else None
        return found

    def finish(self, out, what):
        """Judges what counts as done, finishes the batch and compares it with the undisturbed one."""

        def fail(why):
            self.answer.failures.append(f"{what}: {why}")

        for name, digest in self.digests(out).items():
            if digest != self.whole[name]:
                fail(f"{name} counts as done, and its mesh is not that of an undisturbed run")
        end = time.monotonic() + PATIENCE_S
        while (
            again := subprocess.run(self.command(out, "--retry"), cwd=self.folder, capture_output=True, text=True)
        ).returncode != 0:
            if time.monotonic() > end:
                fail(f"the batch cannot be finished: {again.stderr.strip()[-300:]}")
                break
            time.sleep(0.2)
        if self.digests(out) != self.whole:
            fail("after it was finished, a mesh differs from that of an undisturbed run")
        verified = subprocess.run(self.command(out, "--verify", "--table"), cwd=self.folder, capture_output=True)
        if verified.returncode != 0:
            fail(f"--verify ends with {verified.returncode}")
        shutil.rmtree(self.folder / out)


def run(campaign):
    answer = Answer(
        "batch_faults",
        "`batch` of two scans killed (SIGKILL) at random moments, its steps living on, or with failing "
        "writes, syncs and renames (I/O error, disk full), then finished",
        campaign.count(4, 200),
    )
    batch = Batch(campaign, answer)
    has_strace = shutil.which("strace") is not None
    progress = campaign.progress(answer)
    for i in progress.rest():
        out, chance = f"out-{i}", progress.chance(i)
        if i % 2 == 1 and has_strace:
            call = chance.choice(list(CALLS))
            when = chance.randint(1, CALLS[call])
            error, repeat = chance.choice([("EIO", ""), ("ENOSPC", "+")])
            what = f"{call} {when}{repeat} fails with {error}"
            inject = f"inject={call}:error={error}:when={when}{repeat}"
            result = subprocess.run(
                ["strace", "-f", "-qq", "-e", "trace=none", "-e", inject, "-o", "/dev/null", *batch.command(out)],
                cwd=batch.folder,
                capture_output=True,
                timeout=PATIENCE_S,
            )
            if result.returncode < 0 or result.returncode > 128:
                answer.failures.append(f"{what}: crashed with {result.returncode}")
        else:
            delay = chance.uniform(0.0, 1.1 * batch.seconds)
            what = f"killed after {delay:.3f} s"
            process = subprocess.Popen(
                batch.command(out, "--jobs", "2"),
                cwd=batch.folder,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
            )
            time.sleep(delay)
            process.kill()
            process.wait()
        batch.finish(out, what)
    return answer
