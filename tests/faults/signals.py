"""Every signal at random moments of a scan over a board: the light is off soon after, also when the program dies at once."""
import signal
import subprocess
import time

from boards import GrblBoard, rig_with
from campaign import RIG, Answer

SIGNALS = (
    "SIGINT",
    "SIGTERM",
    "SIGHUP",
    "SIGQUIT",
    "SIGPIPE",
    "SIGSEGV",
    "SIGABRT",
    "SIGKILL",
    "SIGINT twice",
    "reader ends",
)
MAX_DARK_S = 0.5
MAX_END_S = {"SIGINT twice": 3.0}  # 5 s after others
START_S = 60.0


def interrupt(process, name):
    if name == "reader ends":
        process.stderr.close()
        process.send_signal(signal.SIGPIPE)
        return
    process.send_signal(getattr(signal, name.split()[0]))
    if name.endswith("twice"):
        time.sleep(0.05)
        process.send_signal(signal.SIGINT)


def run(campaign):
    per_signal = campaign.count(1, 50)
    answer = Answer(
        "signals",
        "each of " + ", ".join(SIGNALS) + " at random moments of `scan` over a GRBL board on a pseudo-terminal",
        per_signal * len(SIGNALS),
    )
    frames = campaign.fresh("replayed")
    subprocess.run(campaign.scan_command(frames), check=True)
    max_dark = campaign.latency(MAX_DARK_S)
    slowest = longest = 0.0
    for name in SIGNALS:
        max_end = campaign.latency(MAX_END_S.get(name, 5.0))
        for i in range(per_signal):
            what = f"{name}, run {i + 1}"
            board = GrblBoard()
            rig = frames.parent / f"rig-{name.replace(' ', '-')}-{i}.toml"
            rig.write_text(rig_with(board, frames, RIG.read_text()))
            scan = campaign.fresh("signalled")
            process = subprocess.Popen(
                campaign.scan_command(scan, rig), stderr=subprocess.PIPE, stdout=subprocess.DEVNULL
            )
            wait_for_light(board, process)
            time.sleep(campaign.random.uniform(0.0, 0.3))
            begin = time.monotonic()
            interrupt(process, name)
            try:
                process.wait(timeout=max_end)
            except subprocess.TimeoutExpired:
                answer.failures.append(f"{what}: still running after {max_end} s")
                process.kill()
                process.wait()
            longest = max(longest, time.monotonic() - begin)
            while board.is_lit() and time.monotonic() < begin + max_end:
                time.sleep(0.005)
            if board.is_lit():
                answer.failures.append(f"{what}: the light stays on")
            else:
                dark = max(0.0, board.switched_off_at - begin)
                slowest = max(slowest, dark)
                if dark > max_dark:
                    answer.failures.append(f"{what}: the light went off after {dark:.2f} s")
            board.close()
            if process.stderr:
                process.stderr.close()
    answer.measured = f"light off within {slowest:.2f} s, ended within {longest:.2f} s"
    return answer


def wait_for_light(board, process):
    end = time.monotonic() + START_S
    while not board.is_lit() and process.poll() is None and time.monotonic() < end:
        time.sleep(0.002)
    if not board.is_lit():
        errors = (
            process.communicate(timeout=5)[1].decode() if process.poll() is not None else f"no light after {START_S} s"
        )
        raise SystemExit(f"faults: the scan over the emulated board did not start: {errors}")
