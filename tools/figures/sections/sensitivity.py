"""What half and double of each parameter of the fusion do to six scans, for docs/parameters.md."""
import subprocess
import sys

from study import ROOT


def measure(study):
    study.build("fusion_sensitivity")
    subprocess.run(
        [
            sys.executable,
            ROOT / "tools" / "sensitivity.py",
            study.program,
            ROOT / "build/release/bin/fusion_sensitivity",
            ROOT / "docs" / "parameters.md",
            study.work / "sensitivity",
        ],
        check=True,
    )
