"""The way of docs/calibration.md without hardware: from a rig of which sizes are known to a measured ball bar."""
import re
import shutil

from refine_rig import balls
from study import ROOT

TITLE = "From sizes to a measured ball bar"

COMMANDS = """frangia calibrate board --square 14mm -o board.pdf
frangia calibrate capture simulated-maker.toml -o poses --square 14mm
frangia calibrate rig poses -o rig.toml --report calibration.html
frangia calibrate capture rig.toml -o turned --square 14mm --table
frangia calibrate turntable turned --rig rig.toml -o rig.toml
frangia scan rig.toml -o ball-bar
frangia reconstruct ball-bar -o ball-bar.ply"""


def draw(study, report):
    """The figures of the report as pictures of docs/calibration.md: coverage, residuals, and the first board."""
    html = report.read_text()
    figures = re.findall(r"<figure>(<svg .*?</svg>)<figcaption>(.*?)</figcaption>", html, re.S)
    for name, caption in (("coverage", "Coverage"), ("residuals", "residuals of all points")):
        svg = next(svg for svg, text in figures if caption in text)
        write_picture(name, svg)
    write_picture("board", next(svg for svg, _ in figures if "data:image/png" in svg))


def write_picture(name, svg):
    svg = svg.replace(
        "<svg ", '<svg xmlns="http://www.w3.org/2000/svg" style="background:#f6f6f6;border:1px solid #ccc" ', 1
    )
    (ROOT / "docs" / "images" / f"calibration-{name}.svg").write_text(svg + "\n")


def measure(study, case, seed):
    folder = study.work
    for rig in ("simulated-maker.toml", "simulated-digital.toml"):
        shutil.copy(ROOT / "examples" / rig, folder)
    for command in COMMANDS.splitlines():
        study.process("--quiet", *command.split()[1:], cwd=folder, input="\n" * 20)
    draw(study, folder / "calibration.html")
    return balls(folder / "ball-bar.ply")


def report(text, results):
    errors, spacing = results["maker_path"][0]
    text.add(
        "The commands of [calibration.md](calibration.md), on [examples/simulated-maker.toml](../examples/simulated-maker.toml), with Enter for each pose:\n"
    )
    text.add(f"```text\n{COMMANDS}\n```")
    text.add()
    text.table("", "measured", "true")
    text.row("spacing of the balls, mm", f"{spacing:.4f}", "70")
    text.row("form error of the balls, RMS mm", ", ".join(f"{error:.4f}" for error in errors), "0")
