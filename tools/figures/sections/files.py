"""Exchanges files with other programs, for the tables of docs/files.md."""
import subprocess
import sys

from study import ROOT


def measure(study, case, seed):
    subprocess.run(
        [sys.executable, ROOT / "tools" / "check_files.py", study.program, ROOT / "docs" / "files.md"], check=True
    )
