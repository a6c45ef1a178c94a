"""Measures the figures of docs/figures-capture.md. Usage: figures_capture.py PROGRAM TESTS REPORT [KILLS]

Part of `./run figures`. Everything runs on the simulated rig; nothing here needs hardware.
"""
import json
import pathlib
import subprocess
import sys
import tempfile

from figure_report import Report, ask

PROGRAM, TESTS = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
REPORT = pathlib.Path(sys.argv[3])
KILLS = sys.argv[4] if len(sys.argv) > 4 else "200"
ROOT = pathlib.Path(__file__).resolve().parent.parent
WORK = pathlib.Path(tempfile.mkdtemp(prefix="frangia-capture-"))

report = Report()
tell = report.tell


def run(*arguments):
    return ask(PROGRAM, *arguments)


def figure_of(program, test):
    """What a test prints after the word FIGURE."""
    result = subprocess.run([TESTS / program, f"--gtest_filter={test}"], check=True, capture_output=True, text=True)
    line = next(line for line in result.stdout.splitlines() if line.startswith("FIGURE "))
    return json.loads(line[len("FIGURE "):])


def inspected(scan, truth):
    mesh = WORK / "mesh.ply"
    run("reconstruct", scan, "-o", mesh)
    return run("inspect", mesh, "--reference", truth, "--scan", scan)


def accuracy():
    tell("## A captured scan against a rendered one\n")
    tell("`frangia scan examples/RIG -o SCAN` over simulated devices, 8 views, and `frangia simulate PART` of the same rig; both reconstructed and inspected.\n")
    tell("| rig | part | captured, RMS mm | rendered, RMS mm | covered, captured | covered, rendered |\n|---|---|---|---|---|---|")
    for rig, part, preset in (("simulated-digital", "bracket", "digital"), ("simulated-interferometer", "ball-bar", "angular")):
        run("scan", ROOT / "examples" / f"{rig}.toml", "-o", WORK / rig)
        run("simulate", part, "--rig", preset, "--samples", 4, "-o", WORK / preset)
        truth = WORK / preset / "truth.ply"
        captured, rendered = inspected(WORK / rig, truth), inspected(WORK / preset, truth)
        tell(f"| {rig}.toml | {part} | {captured['rms_mm']:.4f} | {rendered['rms_mm']:.4f} | {100 * captured['covered']:.1f} % | {100 * rendered['covered']:.1f} % |")
    tell()


def gige():
    figure = figure_of("test_devices", "GigeScan.*")
    tell("## Over GigE Vision, 0.5 % of the packets lost\n")
    tell("`test_devices --gtest_filter='GigeScan.*'`: Aravis' fake camera on 127.0.0.1 shows the simulated interferometer, 256 x 256 pixels, 6 views.\n")
    tell("| | measured |\n|---|---|")
    tell(f"| frames, all there | {figure['frames']} |")
    tell(f"| frames taken again | {figure['retries']} |")
    tell(f"| 95 % of the mesh within, mm | {figure['captured_mm']:.4f} |")
    tell(f"| the same of a rendered scan | {figure['rendered_mm']:.4f} |\n")


def steps():
    figure = figure_of("test_scan", "StepControl.PiezoFive*")
    tell("## A piezo that goes 5 % too far, with 1 degree of jitter\n")
    tell("`test_scan --gtest_filter='StepControl.PiezoFive*'`: RMS of the phase about the truth, but for its mean, over the noise limit; 8 frames a set.\n")
    tell("| | over the limit | wanted |\n|---|---|---|")
    tell(f"| without step control, steps taken for what was asked | {figure['first']:.2f} | |")
    tell(f"| with it, the worst of three sets, steps found (AIA) | {figure['corrected']:.2f} | at most 1.20 |")
    tell(f"| the same, steps taken for what was asked | {figure['corrected_plain']:.2f} | |\n")


SHINY = "gloss = 1000\nshininess = 12\n"


def blade():
    tell("## A polished blade\n")
    rig = WORK / "blade.toml"
    text = (ROOT / "examples" / "simulated-digital.toml").read_text()
    text = text.replace("samples = 4", "samples = 1")
    rig.write_text(text.replace('part = "bracket" ', 'part = "blade"\n' + SHINY + "# "))
    run("simulate", "blade", "--views", 1, "-o", WORK / "blade-truth")
    truth = WORK / "blade-truth" / "truth.ply"
    tell(f"The blade with a specular lobe (`{SHINY.splitlines()[0]}`, `{SHINY.splitlines()[1]}` in `[devices.camera]` of examples/simulated-digital.toml, 8 views). Covered: of what a view could measure, the share with mesh within 0.2 mm.\n")
    tell("| `frangia scan --exposure` | ms | covered | wanted |\n|---|---|---|---|")
    best = 0.0
    for exposure in (0.16, 0.31, 0.63, 1.25, 2.5, 5, 10, 20):
        scan = WORK / f"blade-{exposure}"
        run("scan", rig, "--exposure", exposure, "-o", scan)
        covered = covered_of(scan, truth)
        best = max(best, covered)
        tell(f"| {exposure} | | {100 * covered:.1f} % | |")
    scan = WORK / "blade-bracket"
    answer = run("scan", rig, "--exposure", "bracket", "-o", scan)
    tell(f"| best single | | {100 * best:.1f} % | below 80 % |")
    tell(f"| bracket | {', '.join(f'{e:.3g}' for e in answer['exposures_ms'])} | {100 * covered_of(scan, truth):.1f} % | at least 95 % |\n")


def covered_of(scan, truth):
    try:
        return inspected(scan, truth)["covered"]
    except subprocess.CalledProcessError:
        return 0.0  # nothing at all was measured


def kills():
    result = subprocess.run(
        [sys.executable, ROOT / "tools" / "kill_study.py", PROGRAM, ROOT / "tests" / "data" / "small-interferometer.toml", KILLS, "3"],
        capture_output=True, text=True)
    figure = json.loads(result.stdout)
    tell("## Killed at random moments\n")
    tell(f"`tools/kill_study.py PROGRAM tests/data/small-interferometer.toml {KILLS} 3`: SIGKILL, then the same command again until the scan is done.\n")
    tell("| | measured | wanted |\n|---|---|---|")
    tell(f"| kills, over so many scans | {figure['kills']}, {figure['scans']} | 200 |")
    tell(f"| acknowledged frames lost | {figure['lost']} | 0 |")
    tell(f"| scans that differ in a frame or in the mesh | {figure['different']} | 0 |\n")


def overhead():
    tell("## Overhead of a capture\n")
    rig = WORK / "large.toml"
    text = (ROOT / "examples" / "simulated-digital.toml").read_text()
    for small, large in (("[960, 768]", "[1280, 1024]"), ("[1800, 1800]", "[2400, 2400]"), ("[490.45, 377.35]", "[653.9, 503.1]"), ("samples = 4", "samples = 1")):
        text = text.replace(small, large)
    rig.write_text(text)
    answer = run("scan", rig, "--views", 4, "-o", WORK / "large")
    tell("`frangia scan` at 1280 x 1024 pixels, 4 views of 12 frames: the time that is neither the devices' (exposing, settling, moving; here rendering) nor spent waiting for the disk.\n")
    tell("| | measured | wanted |\n|---|---|---|")
    tell(f"| ms a frame | {answer['overhead_ms_per_frame']:.1f} | at most 20 |")
    tell(f"| s in the devices | {answer['device_s']:.1f} | |")
    tell(f"| s waiting for the disk | {answer['disk_s']:.1f} | |\n")


tell("# Figures of capturing\n\nMeasured by `./run figures`, which writes this file; not edited by hand.\n")
for study in (accuracy, gige, steps, blade, overhead, kills):
    study()
report.write(REPORT)
