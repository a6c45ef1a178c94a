"""Measures a section, case by case and seed by seed; results on disk let an interrupted measurement go on.

A section is a module with

    TITLE, PAGE            its heading and its page in docs; without a title it writes its pages itself
    CASES = {case: seeds}  the strata of a full measurement and the number of seeds of each; one case of one seed if missing
    PART                   the seeds of each stratum that a measurement without --full takes, or {case: seeds} for those of
                           which it takes fewer; all if missing
    measure(study, case, seed)  the result of one case, as JSON; seeds count from 1
    report(text, results)  writes the text from {case: [result of seed 1, ...]}
"""
import importlib
import json
import os
import subprocess
import time

from inputs import ROOT, inputs_checksum
from page import Text, write_section
from study import NotAsWanted, NotMeasured, Study
from table import SECTIONS

RECORD = ROOT / "tools" / "figures" / "record.json"
KEPT_MEASUREMENTS = 4  # of a section, by other inputs


def cases_of(section, name, is_full):
    """(case, seed) of all cases of a measurement."""
    seeds = getattr(section, "CASES", {name: 1})
    part = {} if is_full else getattr(section, "PART", {})
    part = part if isinstance(part, dict) else {case: part for case in seeds}
    return [(case, seed) for case, count in seeds.items() for seed in range(1, min(count, part.get(case, count)) + 1)]


class Results:
    """The results of a section with the same inputs, one line of JSON for each case: (result, seconds) by (case, seed)."""

    def __init__(self, name, inputs):
        self.inputs = inputs
        self.path = ROOT / "out" / "figures" / "cases" / name / f"{inputs}.jsonl"
        self.path.parent.mkdir(parents=True, exist_ok=True)
        others = sorted(
            (file for file in self.path.parent.glob("*.jsonl") if file != self.path),
            key=lambda file: file.stat().st_mtime,
        )
        for old in others[: 1 - KEPT_MEASUREMENTS]:
            old.unlink()
        self.known = {}
        for line in self.path.read_text().splitlines() if self.path.exists() else ():
            try:
                case, seed, seconds, result = json.loads(line)
            except ValueError:
                continue  # an interruption ended the line
            self.known[case, seed] = result, seconds

    def forget(self):
        self.path.unlink(missing_ok=True)
        self.known = {}

    def add(self, case, seed, seconds, result):
        line = json.dumps([case, seed, seconds, result], default=lambda value: value.tolist())  # values of NumPy
        with self.path.open("a") as file:
            file.write("\n" * self.ends_within_a_line() + line + "\n")
        self.known[case, seed] = json.loads(line)[3], seconds

    def ends_within_a_line(self):
        return self.path.exists() and not self.path.read_bytes().endswith(b"\n")

    def seconds(self, cases):
        return sum(self.known[case][1] for case in cases)


def read_record():
    """Of each section, for its part and in full: inputs, revision, seconds and number of cases of the last measurement.

    Measurements from before there was a record have no more than a revision.
    """
    return json.loads(RECORD.read_text()) if RECORD.exists() else {}


def write_record(name, entry):
    record = {**read_record(), name: entry}
    lines = [
        f"{json.dumps(one)}: {json.dumps(record[one])}" for one in SECTIONS if one in record
    ]  # a line each, to merge
    temporary = RECORD.with_suffix(".tmp")
    temporary.write_text("{\n" + ",\n".join(lines) + "\n}\n")
    os.replace(temporary, RECORD)


def is_changed(name, is_full):
    """Whether anything that a section depends on has changed since its last measurement."""
    entry = read_record().get(name, {}).get("full" if is_full else "part")
    return entry is None or entry["inputs"] != inputs_checksum(name, SECTIONS[name])


def expected_s(name, is_full, count):
    """The time of a number of cases, from the last measurement, else from the estimate of the table."""
    entry = read_record().get(name, {})
    timed = [entry[kind] for kind in ("full" if is_full else "part", "part") if "seconds" in entry.get(kind, {})]
    return count * (timed[0]["seconds"] / timed[0]["cases"] if timed else SECTIONS[name].case_s)


def time_text(seconds):
    if seconds < 100:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 100 * 60 else f"{seconds / 3600:.1f} h"


def revision():
    """The revision of the sources that are measured; with a word where they differ from it."""

    def git(*arguments):
        return subprocess.run(["git", *arguments], cwd=ROOT, capture_output=True, text=True).stdout.strip()

    changes = git("status", "--porcelain", "--untracked-files=no", "--", ".", ":!docs", ":!tools/figures/record.json")
    return (git("rev-parse", "--short=8", "HEAD") or "unknown") + (" with changes" if changes else "")


def run_cases(section, study, results, left):
    for number, (case, seed) in enumerate(left, 1):
        study.scans.in_use.clear()
        begin = time.monotonic()
        result = section.measure(study, case, seed)
        results.add(case, seed, round(time.monotonic() - begin, 2), result)
        print(f"  {number} of {len(left)}: {case}, seed {seed}: {time_text(results.known[case, seed][1])}", flush=True)


def say_what_is_measured(name, section, is_full, count, left):
    """What a section measures, and how long it takes."""
    lines = [f"==> figures {name}: {section.__doc__.splitlines()[0]}"]
    lines.append(f"{left} of {count} cases are to be measured, about {time_text(expected_s(name, is_full, left))}")
    if left < count:
        lines.append(f"{count - left} are known by the same inputs; `--again` measures them again")
    every = len(cases_of(section, name, True))
    if every > count:
        lines.append(f"`--full` has {every} cases, about {time_text(expected_s(name, True, every))}")
    print("\n" + "\n".join(lines), flush=True)


def write_results(name, section, text, results, cases):
    """Writes the page of a section and its record."""
    part, every, at = cases_of(section, name, False), cases_of(section, name, True), revision()
    title = getattr(section, "TITLE", None)
    if title:
        which = f"{' --full' * (cases == every)}`, {len(cases)} of {len(every)} cases," if part != every else "`"
        text.add(f"\nMeasured by `./run figures {name}{which} at revision {at}.")
        page = ROOT / "docs" / getattr(section, "PAGE", "figures.md")
        write_section(page, list(SECTIONS), name, title, str(text), cases == every)
    entry = read_record().get(name, {})
    for kind, measured in (("part", part), ("full", every)):
        if all(case in cases for case in measured):
            seconds = round(results.seconds(measured))
            entry[kind] = {"inputs": results.inputs, "revision": at, "seconds": seconds, "cases": len(measured)}
    write_record(name, entry)


def measure(program, name, is_full, again=False):
    """Measures a section and writes its page and its record; False where a result is not as wanted."""
    section, results = importlib.import_module(name), Results(name, inputs_checksum(name, SECTIONS[name]))
    if again:
        results.forget()
    every = cases_of(section, name, True)
    cases = every if all(case in results.known for case in every) else cases_of(section, name, is_full)
    left = [case for case in cases if case not in results.known]
    say_what_is_measured(name, section, is_full, len(cases), len(left))
    text, by_case = Text(), {case: [] for case, _ in cases}
    try:
        run_cases(section, Study(program, name, SECTIONS[name]), results, left)
        for case, seed in cases:
            by_case[case].append(results.known[case, seed][0])
        if hasattr(section, "report"):
            section.report(text, by_case)
    except NotMeasured as reason:
        print(f"figures: {name} is not measured: {reason}", flush=True)
        return True
    except NotAsWanted as reason:
        print(f"{text}\n\nfigures: {name} is not as wanted, and its page stays as it is: {reason}", flush=True)
        return False
    print(f"\n{text}", flush=True)
    write_results(name, section, text, results, cases)
    return True
