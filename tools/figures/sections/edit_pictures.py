"""Draws every edit before and after, for docs/editing.md."""
import subprocess
import sys

from study import ROOT


def measure(study, case, seed):
    subprocess.run(
        [sys.executable, ROOT / "tools" / "edit_pictures.py", study.program, ROOT / "docs" / "images" / "editing"],
        check=True,
    )
