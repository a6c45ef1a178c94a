"""A system call of `scan` fails, by strace's injection: once (I/O error) or from then on (disk full)."""
import shutil
import subprocess

from campaign import Answer, count_lost

CALLS = {"write,writev": 60, "fsync": 20, "fdatasync": 20, "rename": 20, "mkdir": 4, "ftruncate": 2}


def run(campaign):
    answer = Answer(
        "io_errors",
        "a write, sync, rename or mkdir of `scan` fails (I/O error, disk full), then finished",
        campaign.count(4, 120),
    )
    if not shutil.which("strace"):
        raise SystemExit("faults: io_errors needs strace; install it")
    for i in range(answer.tried):
        call = campaign.random.choice(list(CALLS))
        when = campaign.random.randint(1, CALLS[call])
        error, repeat = (("EIO", ""), ("ENOSPC", "+"))[i % 2]
        scan = campaign.fresh("failing")
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
                *campaign.scan_command(scan),
            ],
            capture_output=True,
            text=True,
            timeout=120,
        )
        if result.returncode < 0 or result.returncode > 128:
            answer.failures.append(f"{what}: crashed with {result.returncode}: {result.stderr.strip()}")
        if result.returncode == 0 and not (scan / "scan.toml").exists():
            answer.failures.append(f"{what}: exit code 0, but no scan.toml")
        if count_lost(scan):
            answer.failures.append(f"{what}: an acknowledged frame is lost")
        campaign.finish(scan, answer, what)
    return answer
