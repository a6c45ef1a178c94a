"""A blade with a specular lobe, captured at one exposure and at several."""
import subprocess

from study import ROOT

PAGE = "figures-capture.md"
TITLE = "A polished blade"

SHINY = "gloss = 1000\nshininess = 12\n"


def completeness(study, scan, truth):
    try:
        return study.inspected(scan, truth)["completeness"]
    except subprocess.CalledProcessError:
        return 0.0  # nothing was measured


def measure(study):
    rig = study.work / "blade.toml"
    text = (ROOT / "examples" / "simulated-digital.toml").read_text().replace("samples = 4", "samples = 1")
    rig.write_text(text.replace('part = "bracket" ', 'part = "blade"\n' + SHINY + "# "))
    truth = study.made("blade-truth", "simulate", "blade", "--views", 1) / "truth.ply"
    study.add(
        f"The blade with a specular lobe (`{SHINY.splitlines()[0]}`, `{SHINY.splitlines()[1]}` in `[devices.camera]` of examples/simulated-digital.toml, 8 views). Completeness: share of the measurable surface that has mesh within 0.2 mm.\n"
    )
    study.table("`frangia scan --exposure`", "ms", "completeness", "wanted")
    best = 0.0
    for exposure in (0.16, 0.31, 0.63, 1.25, 2.5, 5, 10, 20):
        share = completeness(study, study.captured(f"blade-{exposure}", rig, "--exposure", exposure), truth)
        best = max(best, share)
        study.row(exposure, "", f"{100 * share:.1f} %", "")
    scan = study.work / "blade-bracket"
    answer = study.run("scan", rig, "--exposure", "bracket", "-o", scan)
    study.row("best single", "", f"{100 * best:.1f} %", "below 80 %")
    study.row(
        "bracket",
        ", ".join(f"{e:.3g}" for e in answer["exposures_ms"]),
        f"{100 * completeness(study, scan, truth):.1f} %",
        "at least 95 %",
    )
