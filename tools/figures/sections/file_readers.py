"""Reads the written files with other programs, for the table of docs/files.md."""
import subprocess
import sys

from study import ROOT


def measure(study, case, seed):
    subprocess.run(
        [sys.executable, ROOT / "tools" / "check_files.py", study.program, ROOT / "docs" / "files.md"], check=True
    )
