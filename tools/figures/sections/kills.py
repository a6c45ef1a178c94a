"""Scans killed at random moments and started again."""
import json
import subprocess
import sys

from study import ROOT

PAGE = "figures-capture.md"
TITLE = "Killed at random moments"


def measure(study, kills=200):
    command = [sys.executable, ROOT / "tools" / "kill_study.py", study.program, ROOT / "tests" / "data" / "small-interferometer.toml", str(kills), "3"]
    figure = json.loads(subprocess.run(command, capture_output=True, text=True).stdout)
    study.add(f"`tools/kill_study.py PROGRAM tests/data/small-interferometer.toml {kills} 3`: SIGKILL, then the same command again until the scan is complete.\n")
    study.table("", "measured", "wanted")
    study.row("kills, scans", f"{figure['kills']}, {figure['scans']}", kills)
    study.row("acknowledged frames lost", figure["lost"], 0)
    study.row("scans that differ in a frame or in the mesh", figure["different"], 0)
