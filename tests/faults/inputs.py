"""Mutated files of every format: no crash, no hang, no unbounded memory, no control characters in the terminal."""
import pathlib
import subprocess
import sys

from campaign import Answer

SCRIPT = pathlib.Path(__file__).resolve().parent / "mutate_inputs.py"


def run(campaign):
    answer = Answer(
        "inputs",
        "mutated files of every format, read by the verbs with 2 GB of memory and 5 s of processor time",
        campaign.count(40, 10000),
    )
    command = [
        sys.executable,
        SCRIPT,
        campaign.program,
        str(answer.tried),
        "--seed",
        str(campaign.random.getrandbits(30)),
        "--keep",
        campaign.work / "found",
    ]
    result = subprocess.run(command, capture_output=True, text=True)
    lines = (result.stdout + result.stderr).strip().splitlines()
    if result.returncode != 0:
        answer.failures += [line for line in lines if ", seed " in line] or [
            f"mutate_inputs.py ended with {result.returncode}"
        ]
    else:
        answer.measured = result.stdout.splitlines()[-1]
    return answer
