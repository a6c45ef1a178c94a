"""Tries faults on the whole program: python3 tests/faults PROGRAM [--long] [--page docs/reliability.md] [--seed N] [--asan PROGRAM] [NAME...]

The short run is part of `./run test`, the long one is `./run faults`, which writes the table of docs/reliability.md.
Ends with exit code 1 and one sentence for each failure.
"""
import argparse
import importlib
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from campaign import ROOT, Campaign  # noqa: E402

STUDIES = [
    "kills",
    "power_cuts",
    "io_errors",
    "two_sessions",
    "signals",
    "device_faults",
    "memory",
    "inputs",
    "mutated_files",
    "batch_faults",
    "batch_cuts",
    "transactions",
    "hostile_requests",
]
BEGIN, END = "<!-- begin table: written by `./run faults` -->", "<!-- end table -->"


def revision():
    """What was tried: the revision, and whether the sources are its own."""

    def said_by_git(*words):
        return subprocess.run(["git", *words], cwd=ROOT, capture_output=True, text=True).stdout.strip()

    changed = said_by_git("status", "--porcelain", "--", "src", "apps")
    return said_by_git("rev-parse", "--short=8", "HEAD") + (" and changes" if changed else "")


def write_row(page, answer, tried_at):
    text = page.read_text()
    rows = {
        line.split("`")[1]: line for line in text.split(BEGIN)[1].split(END)[0].splitlines() if line.startswith("| `")
    }
    cells = [f"`{answer.name}`", answer.title, answer.tried, len(answer.failures), answer.measured, tried_at]
    rows[answer.name] = f"| {' | '.join(str(cell) for cell in cells)} |"
    ordered = [rows[name] for name in STUDIES if name in rows]
    table = [
        "",
        "| study | what was done | tried | failed | measured | revision |",
        "|---|---|---|---|---|---|",
        *ordered,
        "",
    ]
    temporary = page.with_suffix(".tmp")
    temporary.write_text(text.split(BEGIN)[0] + BEGIN + "\n".join(table) + "\n" + END + text.split(END)[1])
    os.replace(temporary, page)


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("program")
    arguments.add_argument("--long", action="store_true")
    arguments.add_argument("--page", type=pathlib.Path)
    arguments.add_argument("--seed", type=int, default=1)
    arguments.add_argument(
        "--asan", type=pathlib.Path, help="a program built with sanitizers, for the study mutated_files"
    )
    arguments.add_argument("names", nargs="*", metavar="NAME", help=f"of {', '.join(STUDIES)}")
    chosen = arguments.parse_intermixed_args()
    for name in chosen.names:
        if name not in STUDIES:
            sys.exit(f"faults: there is no study '{name}'; the studies are {', '.join(STUDIES)}")
    failed, tried_at = 0, revision()
    for name in chosen.names or STUDIES:
        work = tempfile.mkdtemp(prefix="frangia-faults-")
        begin = time.monotonic()
        answer = importlib.import_module(name).run(
            Campaign(chosen.program, work, chosen.long, chosen.seed, chosen.asan)
        )
        print(
            f"{name}: {answer.tried} tried, {len(answer.failures)} failed, {time.monotonic() - begin:.0f} s; {answer.measured}",
            flush=True,
        )
        for failure in answer.failures:
            print(f"  {failure}", flush=True)
        failed += len(answer.failures)
        if chosen.page:
            write_row(chosen.page, answer, tried_at)
        if answer.failures:
            print(f"  the files of the failed runs are in {work}", flush=True)
        else:
            shutil.rmtree(work)
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
