"""The time that a capture takes in addition to the devices and the disk."""
from study import ROOT

PAGE = "figures-capture.md"
TITLE = "Overhead of a capture"


def measure(study, case, seed):
    rig = study.work / "overhead.toml"
    text = (ROOT / "examples" / "simulated-digital.toml").read_text()
    for small, large in (
        ("[960, 768]", "[1280, 1024]"),
        ("[1800, 1800]", "[2400, 2400]"),
        ("[490.45, 377.35]", "[653.9, 503.1]"),
        ("samples = 4", "samples = 1"),
    ):
        text = text.replace(small, large)
    rig.write_text(text)
    return study.run("scan", rig, "--views", 4, "-o", study.work / "overhead")


def report(text, results):
    answer = results["capture_overhead"][0]
    text.add(
        "`frangia scan` at 1280 x 1024 pixels, 4 views of 12 frames: the time of the program alone, without the devices (exposing, settling, moving; here rendering) and without waiting for the disk.\n"
    )
    text.table("", "measured", "wanted")
    text.row("ms per frame", f"{answer['overhead_ms_per_frame']:.1f}", "at most 20")
    text.row("s in the devices", f"{answer['device_s']:.1f}", "")
    text.row("s waiting for the disk", f"{answer['disk_s']:.1f}", "")
