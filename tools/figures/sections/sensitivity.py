"""What half and double of each parameter of the fusion do to six scans, with half the pixels of the digital rig on a side."""
import json
import subprocess

from study import ROOT

TITLE = "Half and double of each parameter"
PAGE = "parameters.md"

SCANS = [
    ("bust", "digital"),
    ("blade", "digital"),
    ("bracket", "digital"),
    ("shaft", "digital"),
    ("bust", "angular"),
    ("bracket", "angular"),
]
CASES = {f"{part}, {rig}": 1 for part, rig in SCANS}
PART = {"blade, digital": 0, "bracket, digital": 0, "shaft, digital": 0, "bust, angular": 0}
VIEWS = 6

# A change counts from here: RMS and 99 % in per cent, covered in points of per cent, sigmas absolute.
LEAST = {"rms_mm": 0.2, "p99_mm": 0.2, "covered": 0.01, "sigmas": 0.002, "triangles": 0.02}


def measure(study, case, seed):
    """The answers of the benchmark fusion_sensitivity: the values in use, then half and double of each parameter."""
    study.build("fusion_sensitivity")
    part, rig = case.split(", ")
    scan = study.digital(part, study.half_rig if rig == "digital" else rig, "--views", VIEWS)
    answers = subprocess.run(
        [ROOT / "build/release/bin/fusion_sensitivity", scan, "--all"], check=True, capture_output=True, text=True
    )
    return [json.loads(line) for line in answers.stdout.splitlines()]


def change(answer, base, key):
    """Of one answer against the unchanged parameters: per cent, points of per cent, or the difference."""
    if key == "covered":
        return 100 * (answer[key] - base[key])
    if key == "sigmas":
        return answer[key] - base[key]
    return 100 * (answer[key] / base[key] - 1)


def cell(answers_of_scans, name, factor, key):
    """The change with the largest magnitude of all scans."""
    changes = []
    for lines in answers_of_scans:
        answer = next(line for line in lines if line["name"] == name and line["factor"] == factor)
        changes.append(change(answer, lines[0], key))
    worst = max(changes, key=abs)
    if abs(worst) < LEAST[key]:
        return "·"
    return f"{worst:+.2f}" if key in ("covered", "sigmas") else f"{worst:+.1f}"


def report(text, results):
    all_answers = [lines for (lines,) in results.values()]
    keys = ["rms_mm", "p99_mm", "covered", "sigmas", "triangles"]
    rows = ["| scan | triangles | RMS, mm | 99 %, mm | covered, % | sigmas |", "|---|---|---|---|---|---|"]
    for case, lines in zip(results, all_answers):
        base = lines[0]
        rows.append(
            f"| {case} | {base['triangles']} | {base['rms_mm']:.4f} | {base['p99_mm']:.4f} "
            f"| {100 * base['covered']:.2f} | {base['sigmas']:.2f} |"
        )
    rows += [
        "",
        "| parameter | value | half: RMS, 99 %, covered, sigmas, triangles | double: RMS, 99 %, covered, sigmas, triangles |",
        "|---|---|---|---|",
    ]
    idle = []
    for line in all_answers[0][1::2]:
        halves = [cell(all_answers, line["name"], 0.5, key) for key in keys]
        doubles = [cell(all_answers, line["name"], 2.0, key) for key in keys]
        if all(text == "·" for text in halves + doubles):
            idle.append(line["name"])
        value = 2 * line["value"]
        rows.append(f"| `{line['name']}` | {value:.4g} {line['unit']} | {', '.join(halves)} | {', '.join(doubles)} |")
    rows += ["", "Without effect on these scans: " + (", ".join(f"`{name}`" for name in idle) or "none") + "."]
    for row in rows:
        text.add(row)
