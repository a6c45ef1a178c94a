"""Writes the coverage by module as a table: coverage_table.py SUMMARY.json REPORT.md

SUMMARY.json is that of `gcovr --json-summary`. Part of `./run lint coverage`.
"""
import collections
import json
import pathlib
import sys


def share(covered, total):
    return f"{100.0 * covered / total:.1f} %" if total else "-"


summary = json.loads(pathlib.Path(sys.argv[1]).read_text())
modules = collections.defaultdict(lambda: [0, 0, 0, 0])
for file in summary["files"]:
    module = pathlib.PurePath(file["filename"]).parts[2]  # src/frangia/MODULE/...
    for name in (module, "all"):
        for i, key in enumerate(("line_covered", "line_total", "branch_covered", "branch_total")):
            modules[name][i] += file[key]
if not modules:
    sys.exit("coverage_table.py: gcovr found no file of src/frangia; run the tests of the coverage preset first")
lines = [
    "# Coverage",
    "",
    "Lines and branches of the library that `./run test` executes, measured by `./run lint coverage`, which writes "
    "this file (gcc --coverage at -O2, gcovr; branches that only exceptions take are left out).",
    "",
    "| module | lines | branches |",
    "|---|---|---|",
]
for name in sorted(modules, key=lambda name: (name == "all", name)):
    line_covered, line_total, branch_covered, branch_total = modules[name]
    lines.append(
        f"| {name} | {share(line_covered, line_total)} of {line_total} | {share(branch_covered, branch_total)} of {branch_total} |"
    )
text = "\n".join(lines) + "\n"
print(text)
page = pathlib.Path(sys.argv[2])
old = page.read_text() if page.exists() else ""
_, mark, rest = old.partition("\n## ")  # the sections that others write
page.write_text(text + mark + rest)
