"""A blade with a specular lobe, captured at one exposure and at several."""
import subprocess

from study import ROOT

PAGE = "figures-capture.md"
TITLE = "A polished blade"

SHINY = "gloss = 1000\nshininess = 12\n"
EXPOSURES = ("0.16", "0.31", "0.63", "1.25", "2.5", "5", "10", "20")
CASES = {case: 1 for case in (*EXPOSURES, "bracket")}


def completeness(study, scan, truth):
    try:
        return study.inspected(scan, truth)["completeness"]
    except subprocess.CalledProcessError:
        return 0.0  # nothing was measured


def measure(study, case, seed):
    rig = study.work / "blade.toml"
    text = (ROOT / "examples" / "simulated-digital.toml").read_text().replace("samples = 4", "samples = 1")
    rig.write_text(text.replace('part = "bracket" ', 'part = "blade"\n' + SHINY + "# "))
    truth = study.simulated("blade", "--views", 1) / "truth.ply"
    scan, answer = study.captured(rig, "--exposure", case)
    return {"completeness": completeness(study, scan, truth), "exposures_ms": answer.get("exposures_ms")}


def report(text, results):
    text.add(
        f"The blade with a specular lobe (`{SHINY.splitlines()[0]}`, `{SHINY.splitlines()[1]}` in `[devices.camera]` of examples/simulated-digital.toml, 8 views). Completeness: share of the measurable surface that has mesh within 0.2 mm.\n"
    )
    text.table("`frangia scan --exposure`", "ms", "completeness", "wanted")
    shares = {case: result["completeness"] for case, (result,) in results.items()}
    for exposure in EXPOSURES:
        text.row(exposure, "", f"{100 * shares[exposure]:.1f} %", "")
    text.row("best single", "", f"{100 * max(shares[exposure] for exposure in EXPOSURES):.1f} %", "below 80 %")
    text.row(
        "bracket",
        ", ".join(f"{e:.3g}" for e in results["bracket"][0]["exposures_ms"]),
        f"{100 * shares['bracket']:.1f} %",
        "at least 95 %",
    )
