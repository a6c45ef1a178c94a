"""Measures the figures of docs/figures-capture.md. Usage: figures_capture.py PROGRAM TESTS REPORT [KILLS]

Part of `./run figures`. Everything runs on the simulated rig; no hardware is needed.
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
add = report.add


def run(*arguments):
    return ask(PROGRAM, *arguments)


def figure_of(program, test):
    """The JSON that a test prints after the word FIGURE."""
    result = subprocess.run([TESTS / program, f"--gtest_filter={test}"], check=True, capture_output=True, text=True)
    line = next(line for line in result.stdout.splitlines() if line.startswith("FIGURE "))
    return json.loads(line[len("FIGURE "):])


def inspected(scan, truth):
    mesh = WORK / "mesh.ply"
    run("reconstruct", scan, "-o", mesh)
    return run("inspect", mesh, "--reference", truth, "--scan", scan)


def accuracy():
    add("## A captured scan compared with a rendered one\n")
    add("`frangia scan examples/RIG -o SCAN` over simulated devices, 8 views, and `frangia simulate PART` of the same rig; both reconstructed and inspected.\n")
    add("| rig | part | captured, RMS mm | rendered, RMS mm | completeness, captured | completeness, rendered |\n|---|---|---|---|---|---|")
    for rig, part, preset in (("simulated-digital", "bracket", "digital"), ("simulated-interferometer", "ball-bar", "angular")):
        run("scan", ROOT / "examples" / f"{rig}.toml", "-o", WORK / rig)
        run("simulate", part, "--rig", preset, "--samples", 4, "-o", WORK / preset)
        truth = WORK / preset / "truth.ply"
        captured, rendered = inspected(WORK / rig, truth), inspected(WORK / preset, truth)
        add(f"| {rig}.toml | {part} | {captured['rms_mm']:.4f} | {rendered['rms_mm']:.4f} | {100 * captured['completeness']:.1f} % | {100 * rendered['completeness']:.1f} % |")
    add()


def gige():
    figure = figure_of("test_devices", "GigeScan.*")
    add("## Over GigE Vision, 0.5 % of the packets lost\n")
    add("`test_devices --gtest_filter='GigeScan.*'`: Aravis' fake camera on 127.0.0.1 shows the simulated interferometer, 256 x 256 pixels, 6 views.\n")
    add("| | measured |\n|---|---|")
    add(f"| frames, all complete | {figure['frames']} |")
    add(f"| frames captured again | {figure['retries']} |")
    add(f"| 95 % of the mesh has an error within, mm | {figure['captured_mm']:.4f} |")
    add(f"| the same for a rendered scan | {figure['rendered_mm']:.4f} |\n")


def steps():
    figure = figure_of("test_acquisition", "StepControl.PiezoFive*")
    add("## A piezo with a gain error of 5 % and a phase-shift jitter of 1 degree\n")
    add("`test_acquisition --gtest_filter='StepControl.PiezoFive*'`: RMS phase error without its mean, divided by the noise limit; 8 frames per set.\n")
    add("| | error over the noise limit | wanted |\n|---|---|---|")
    add(f"| without step control, nominal steps | {figure['first']:.2f} | |")
    add(f"| with step control, the worst of three sets, steps estimated (AIA) | {figure['corrected']:.2f} | at most 1.20 |")
    add(f"| the same, nominal steps | {figure['corrected_plain']:.2f} | |\n")


SHINY = "gloss = 1000\nshininess = 12\n"


def blade():
    add("## A polished blade\n")
    rig = WORK / "blade.toml"
    text = (ROOT / "examples" / "simulated-digital.toml").read_text()
    text = text.replace("samples = 4", "samples = 1")
    rig.write_text(text.replace('part = "bracket" ', 'part = "blade"\n' + SHINY + "# "))
    run("simulate", "blade", "--views", 1, "-o", WORK / "blade-truth")
    truth = WORK / "blade-truth" / "truth.ply"
    add(f"The blade with a specular lobe (`{SHINY.splitlines()[0]}`, `{SHINY.splitlines()[1]}` in `[devices.camera]` of examples/simulated-digital.toml, 8 views). Completeness: share of the measurable surface that has mesh within 0.2 mm.\n")
    add("| `frangia scan --exposure` | ms | completeness | wanted |\n|---|---|---|---|")
    best = 0.0
    for exposure in (0.16, 0.31, 0.63, 1.25, 2.5, 5, 10, 20):
        scan = WORK / f"blade-{exposure}"
        run("scan", rig, "--exposure", exposure, "-o", scan)
        completeness = completeness_of(scan, truth)
        best = max(best, completeness)
        add(f"| {exposure} | | {100 * completeness:.1f} % | |")
    scan = WORK / "blade-bracket"
    answer = run("scan", rig, "--exposure", "bracket", "-o", scan)
    add(f"| best single | | {100 * best:.1f} % | below 80 % |")
    add(f"| bracket | {', '.join(f'{e:.3g}' for e in answer['exposures_ms'])} | {100 * completeness_of(scan, truth):.1f} % | at least 95 % |\n")


def completeness_of(scan, truth):
    try:
        return inspected(scan, truth)["completeness"]
    except subprocess.CalledProcessError:
        return 0.0  # nothing was measured


def kills():
    result = subprocess.run(
        [sys.executable, ROOT / "tools" / "kill_study.py", PROGRAM, ROOT / "tests" / "data" / "small-interferometer.toml", KILLS, "3"],
        capture_output=True, text=True)
    figure = json.loads(result.stdout)
    add("## Killed at random moments\n")
    add(f"`tools/kill_study.py PROGRAM tests/data/small-interferometer.toml {KILLS} 3`: SIGKILL, then the same command again until the scan is complete.\n")
    add("| | measured | wanted |\n|---|---|---|")
    add(f"| kills, scans | {figure['kills']}, {figure['scans']} | 200 |")
    add(f"| acknowledged frames lost | {figure['lost']} | 0 |")
    add(f"| scans that differ in a frame or in the mesh | {figure['different']} | 0 |\n")


def overhead():
    add("## Overhead of a capture\n")
    rig = WORK / "large.toml"
    text = (ROOT / "examples" / "simulated-digital.toml").read_text()
    for small, large in (("[960, 768]", "[1280, 1024]"), ("[1800, 1800]", "[2400, 2400]"), ("[490.45, 377.35]", "[653.9, 503.1]"), ("samples = 4", "samples = 1")):
        text = text.replace(small, large)
    rig.write_text(text)
    answer = run("scan", rig, "--views", 4, "-o", WORK / "large")
    add("`frangia scan` at 1280 x 1024 pixels, 4 views of 12 frames: the time of the program alone, without the devices (exposing, settling, moving; here rendering) and without waiting for the disk.\n")
    add("| | measured | wanted |\n|---|---|---|")
    add(f"| ms per frame | {answer['overhead_ms_per_frame']:.1f} | at most 20 |")
    add(f"| s in the devices | {answer['device_s']:.1f} | |")
    add(f"| s waiting for the disk | {answer['disk_s']:.1f} | |\n")


add("# Figures of captured scans\n\nMeasured by `./run figures`, which writes this file; not edited by hand.\n")
for study in (accuracy, gige, steps, blade, overhead, kills):
    study()
report.write(REPORT)
