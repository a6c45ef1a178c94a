"""A scan captured through the devices against one that the simulator renders at once."""
from study import ROOT

PAGE = "figures-capture.md"
TITLE = "A captured scan compared with a rendered one"

RIGS = {"simulated-digital": ("bracket", "digital"), "simulated-interferometer": ("ball-bar", "angular")}
CASES = {rig: 1 for rig in RIGS}


def measure(study, case, seed):
    rendered = study.digital(*RIGS[case])
    captured, _ = study.captured(ROOT / "examples" / f"{case}.toml")
    return [study.inspected(scan, rendered / "truth.ply") for scan in (captured, rendered)]


def report(text, results):
    text.add(
        "`frangia scan examples/RIG -o SCAN` over simulated devices, 8 views, and `frangia simulate PART` of the same rig; both reconstructed and inspected.\n"
    )
    text.table(
        "rig", "part", "captured, RMS mm", "rendered, RMS mm", "completeness, captured", "completeness, rendered"
    )
    for rig, (comparisons,) in results.items():
        text.row(
            f"{rig}.toml",
            RIGS[rig][0],
            *(f"{one['rms_mm']:.4f}" for one in comparisons),
            *(f"{100 * one['completeness']:.1f} %" for one in comparisons),
        )
