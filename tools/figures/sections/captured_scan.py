"""A scan captured through the devices against one that the simulator renders at once."""
from study import ROOT

PAGE = "figures-capture.md"
TITLE = "A captured scan compared with a rendered one"


def measure(study):
    study.add(
        "`frangia scan examples/RIG -o SCAN` over simulated devices, 8 views, and `frangia simulate PART` of the same rig; both reconstructed and inspected.\n"
    )
    study.table(
        "rig", "part", "captured, RMS mm", "rendered, RMS mm", "completeness, captured", "completeness, rendered"
    )
    for rig, part, preset in (
        ("simulated-digital", "bracket", "digital"),
        ("simulated-interferometer", "ball-bar", "angular"),
    ):
        rendered_scan = study.simulated(part, preset)
        captured_scan = study.captured(f"captured-{preset}", ROOT / "examples" / f"{rig}.toml")
        captured, rendered = (
            study.inspected(scan, rendered_scan / "truth.ply") for scan in (captured_scan, rendered_scan)
        )
        study.row(
            f"{rig}.toml",
            part,
            f"{captured['rms_mm']:.4f}",
            f"{rendered['rms_mm']:.4f}",
            f"{100 * captured['completeness']:.1f} %",
            f"{100 * rendered['completeness']:.1f} %",
        )
