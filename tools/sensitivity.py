#!/usr/bin/env python3
"""Measures how sensitive the fused mesh is to each parameter of the fusion.

usage: sensitivity.py PROGRAM STUDY docs/parameters.md [FOLDER]

PROGRAM is the frangia program and STUDY is fusion_sensitivity of the benchmarks. Six small scans are
simulated once into FOLDER (out/sensitivity), with half the pixels of the digital rig on a side. For each,
STUDY fuses the views with half and with double of each parameter and compares the meshes with the truth.
Its answers are kept as JSON lines next to the scans; a scan whose answers exist is not measured again. The
script writes the table of the page.
"""
import json
import pathlib
import subprocess
import sys

from half_rig import half_rig

SCANS = [
    ("bust", "digital"),
    ("blade", "digital"),
    ("bracket", "digital"),
    ("shaft", "digital"),
    ("bust", "angular"),
    ("bracket", "angular"),
]
VIEWS = 6
FOLDER = pathlib.Path("out/sensitivity")
MARK = "<!-- sensitivity: the rest of this page is written by tools/sensitivity.py -->"

# A change counts from here: RMS and 99 % in per cent, covered in points of per cent, sigmas absolute.
LEAST = {"rms_mm": 0.2, "p99_mm": 0.2, "covered": 0.01, "sigmas": 0.002, "triangles": 0.02}


def answers(program, study, part, rig):
    scan, kept = FOLDER / f"{part}-{rig}", FOLDER / f"{part}-{rig}.jsonl"
    if not kept.exists():
        if not (scan / "scan.toml").exists():
            model = half_rig(program, FOLDER) if rig == "digital" else rig
            subprocess.run(
                [
                    program,
                    "--quiet",
                    "simulate",
                    part,
                    "--rig",
                    model,
                    "--samples",
                    "4",
                    "--views",
                    str(VIEWS),
                    "-o",
                    scan,
                ],
                check=True,
            )
        unfinished = kept.with_suffix(".unfinished")
        with unfinished.open("w") as output:
            subprocess.run([study, scan, "--all"], check=True, stdout=output)
        unfinished.rename(kept)
    return [json.loads(line) for line in kept.read_text().splitlines()]


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


def table(all_answers):
    keys = ["rms_mm", "p99_mm", "covered", "sigmas", "triangles"]
    rows = ["| scan | triangles | RMS, mm | 99 %, mm | covered, % | sigmas |", "|---|---|---|---|---|---|"]
    for (part, rig), lines in zip(SCANS, all_answers):
        base = lines[0]
        rows.append(
            f"| {part}, {rig} | {base['triangles']} | {base['rms_mm']:.4f} | {base['p99_mm']:.4f} "
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
    return rows


def main(program, study, page):
    FOLDER.mkdir(parents=True, exist_ok=True)
    all_answers = []
    for part, rig in SCANS:
        print(f"{part}, {rig}", flush=True)
        all_answers.append(answers(program.resolve(), study.resolve(), part, rig))
    head = page.read_text().split(MARK)[0] if page.exists() else ""
    page.write_text(head + MARK + "\n\n" + "\n".join(table(all_answers)) + "\n")


if __name__ == "__main__":
    if len(sys.argv) not in (4, 5):
        sys.exit(__doc__)
    if len(sys.argv) == 5:
        FOLDER = pathlib.Path(sys.argv[4])
    main(*map(pathlib.Path, sys.argv[1:4]))
