"""A board that misbehaves from a random command on: the scan ends, its message names the port, and the light is off."""
import subprocess
import time

from boards import FAULTS, GrblBoard, rig_with
from campaign import RIG, Answer

PATIENCE_S = 1
MAX_END_S = 30.0
MAX_DARK_S = 5.0


def run(campaign):
    answer = Answer(
        "device_faults",
        "a GRBL board on a pseudo-terminal is " + ", ".join(FAULTS) + " from a random command on",
        campaign.count(len(FAULTS), 108),
    )
    frames = campaign.fresh("replayed")
    subprocess.run(campaign.scan_command(frames), check=True)
    max_end, max_dark = campaign.latency(MAX_END_S), campaign.latency(MAX_DARK_S)
    slowest = 0.0
    for i in range(answer.tried):
        fault = FAULTS[i % len(FAULTS)]
        board = GrblBoard(fault, campaign.random.randint(0, 30))
        what = f"{fault} from command {board.fault_at} on"
        rig = frames.parent / f"rig-{i}.toml"
        rig.write_text(rig_with(board, frames, RIG.read_text()))
        scan = campaign.fresh("misbehaving")
        command = [*campaign.scan_command(scan, rig), "--patience", str(PATIENCE_S)]
        process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
        try:
            errors = process.communicate(timeout=max_end)[1]
        except subprocess.TimeoutExpired:
            answer.failures.append(f"{what}: still running after {max_end} s")
            process.kill()
            errors = process.communicate()[1]
        begin = time.monotonic()
        while board.is_lit() and time.monotonic() < begin + max_dark:
            time.sleep(0.01)
        slowest = max(slowest, time.monotonic() - begin)
        board_can_hear = fault != "unplugged"
        if board.is_lit() and board_can_hear:
            answer.failures.append(f"{what}: the light stays on")
        if process.returncode < 0:
            answer.failures.append(f"{what}: crashed with {process.returncode}")
        elif process.returncode != 0 and board.port not in errors:
            answer.failures.append(f"{what}: the message does not name the port: {errors.strip().splitlines()[-1:]}")
        board.close()
    answer.measured = f"light off at most {slowest:.2f} s after the end"
    return answer
