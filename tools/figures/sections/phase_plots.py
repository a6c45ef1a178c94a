"""Draws the plots of docs/phase.md and docs/surface.md from the times that `./run bench` left."""
import subprocess
import sys

from study import ROOT, NotMeasured


def measure(study, case, seed):
    bench, docs = ROOT / "out" / "bench", ROOT / "docs"
    if not (bench / "phase.json").exists():
        raise NotMeasured("the plots of times need out/bench; run `./run bench` first")
    subprocess.run([sys.executable, ROOT / "tools" / "plot_phase.py", study.program, bench, docs / "phase"], check=True)
    subprocess.run(
        [sys.executable, ROOT / "tools" / "plot_fusion.py", bench, docs / "images" / "surface-time.svg"], check=True
    )
