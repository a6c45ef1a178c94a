"""Draws the pictures of docs/surface.md."""
import subprocess
import sys

from study import ROOT


def measure(study, case, seed):
    subprocess.run(
        [sys.executable, ROOT / "tools" / "surface_pictures.py", study.program, ROOT / "docs" / "images"], check=True
    )
