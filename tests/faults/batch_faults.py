"""`batch` is killed, or a write, sync or rename of it or its steps fails: what counts as done has its meshes, and the rest can be done."""
import hashlib
import json
import shutil
import subprocess
import time

from campaign import ROOT, Answer

NAMES = ["a", "b"]
CALLS = {"write,writev": 60, "fsync": 12, "fdatasync": 4, "rename": 12, "mkdir": 3}
PATIENCE_S = 120  # for a step that outlives its batch


def digests(out):
    """The hash of each mesh that counts as done."""
    found = {}
    for name in NAMES:
        mark = out / name / "done.json"
        if mark.exists() and json.loads(mark.read_text())["row"]["state"] == "done":
            mesh = out / name / "mesh.ply"
            found[name] = hashlib.sha256(mesh.read_bytes()).hexdigest() if mesh.exists() else None
    return found


def run(campaign):
    answer = Answer(
        "batch_faults",
        "`batch` of two scans killed (SIGKILL) at random moments, its steps living on, or with failing "
        "writes, syncs and renames (I/O error, disk full), then finished",
        campaign.count(4, 200),
    )
    scans = campaign.fresh("batch").parent
    for i, name in enumerate(NAMES):
        subprocess.run(
            [
                campaign.program,
                "--quiet",
                "simulate",
                "plate",
                "--rig",
                ROOT / "examples" / "python" / "small-rig.toml",
                "--views",
                str(3 + i),
                "-o",
                scans / "scans" / name,
            ],
            check=True,
        )

    def command(out, *more):
        return [campaign.program, "--quiet", "batch", "scans", "-o", out, *more]

    begin = time.monotonic()
    subprocess.run(command("whole"), cwd=scans, check=True)
    seconds = time.monotonic() - begin
    whole = digests(scans / "whole")
    has_strace = shutil.which("strace") is not None
    for i in range(answer.tried):
        out = f"out-{i}"
        if i % 2 == 1 and has_strace:
            call = campaign.random.choice(list(CALLS))
            when = campaign.random.randint(1, CALLS[call])
            error, repeat = campaign.random.choice([("EIO", ""), ("ENOSPC", "+")])
            what = f"{call} {when}{repeat} fails with {error}"
            result = subprocess.run(
                [
                    "strace",
                    "-f",
                    "-qq",
                    "-e",
                    "trace=none",
                    "-e",
                    f"inject={call}:error={error}:when={when}{repeat}",
                    "-o",
                    "/dev/null",
                    *command(out),
                ],
                cwd=scans,
                capture_output=True,
                timeout=PATIENCE_S,
            )
            if result.returncode < 0 or result.returncode > 128:
                answer.failures.append(f"{what}: crashed with {result.returncode}")
        else:
            delay = campaign.random.uniform(0.0, 1.1 * seconds)
            what = f"killed after {delay:.3f} s"
            process = subprocess.Popen(
                command(out, "--jobs", "2"), cwd=scans, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
            )
            time.sleep(delay)
            process.kill()
            process.wait()
        for name, digest in digests(scans / out).items():
            if digest != whole[name]:
                answer.failures.append(f"{what}: {name} counts as done, and its mesh is not that of an undisturbed run")
        end = time.monotonic() + PATIENCE_S
        while (
            again := subprocess.run(command(out, "--retry"), cwd=scans, capture_output=True, text=True)
        ).returncode != 0:
            if time.monotonic() > end:
                answer.failures.append(f"{what}: the batch cannot be finished: {again.stderr.strip()[-300:]}")
                break
            time.sleep(0.2)
        if digests(scans / out) != whole:
            answer.failures.append(f"{what}: after it was finished, a mesh differs from that of an undisturbed run")
        verified = subprocess.run(command(out, "--verify", "--table"), cwd=scans, capture_output=True, text=True)
        if verified.returncode != 0:
            answer.failures.append(f"{what}: --verify ends with {verified.returncode}")
        shutil.rmtree(scans / out)
    return answer
