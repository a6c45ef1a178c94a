"""Prints the ten slowest tests, the time of each module and how many passed: test_times.py RESULTS.xml... [--page PAGE.md]

RESULTS.xml are files of `ctest --output-junit`. With --page, the table of modules is written into PAGE.md instead, between
its markers. The times are wall times of tests that ran beside others. Part of `./run test` and `./run lint coverage`.
"""
import argparse
import collections
import os
import pathlib
import xml.etree.ElementTree

BEGIN, END = "<!-- begin times: written by tools/test_times.py -->", "<!-- end times -->"


def read_results(path):
    """(name, seconds, state) of each test; the state is passed, failed or skipped."""
    results = []
    for case in xml.etree.ElementTree.parse(path).getroot().iter("testcase"):
        skipped = case.find("skipped") is not None or case.get("status") in ("notrun", "disabled")
        state = (
            "failed"
            if case.find("failure") is not None or case.get("status") == "fail"
            else "skipped"
            if skipped
            else "passed"
        )
        results.append((case.get("name"), float(case.get("time") or 0.0), state))
    return results


def by_module(results):
    """(module, number of tests, seconds), the longest first. The module is the first word of a test's name."""
    sums = collections.defaultdict(lambda: [0, 0.0])
    for name, seconds, _ in results:
        total = sums[name.split(".")[0]]
        total[0] += 1
        total[1] += seconds
    return sorted(
        ((module, count, seconds) for module, (count, seconds) in sums.items()), key=lambda row: (-row[2], row[0])
    )


def count(results):
    states = collections.Counter(state for _, _, state in results)
    line = f"{states['passed']} passed, {states['failed']} failed"
    return line + (f", {states['skipped']} skipped" if states["skipped"] else "")


def report(results):
    modules = by_module(results)
    lines = ["the slowest tests:"]
    lines += [f"{seconds:8.1f} s  {name}" for name, seconds, _ in sorted(results, key=lambda test: -test[1])[:10]]
    lines += ["", "the time of each module:"]
    lines += [f"{seconds:8.1f} s  {module} ({number} tests)" for module, number, seconds in modules]
    lines += [f"{sum(seconds for _, _, seconds in modules):8.1f} s  in all"]
    failed = [name for name, _, state in results if state == "failed"]
    if failed:
        lines += ["", "failed:", *(f"  {name}" for name in failed)]
    return "\n".join([*lines, "", count(results)])


def table(results):
    modules = by_module(results)
    lines = ["", "| module | tests | seconds |", "|---|---|---|"]
    lines += [f"| {module} | {number} | {seconds:.1f} |" for module, number, seconds in modules]
    lines += [f"| all | {len(results)} | {sum(seconds for _, _, seconds in modules):.0f} |", ""]
    return "\n".join(lines)


def write_page(page, results):
    text = page.read_text()
    if BEGIN not in text:
        text += (
            f"\n## Time of the tests\n\nWall time of the tests of each module in the last whole `./run test`. It runs one test more "
            f"than there are processors at the same time, so a test takes longer than it would alone.\n\n{BEGIN}\n{END}\n"
        )
    temporary = page.with_suffix(".tmp")
    temporary.write_text(text.split(BEGIN)[0] + BEGIN + table(results) + END + text.split(END)[1])
    os.replace(temporary, page)


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("results", nargs="+", type=pathlib.Path)
    arguments.add_argument("--page", type=pathlib.Path)
    given = arguments.parse_args()
    results = [test for path in given.results for test in read_results(path)]
    if given.page:
        write_page(given.page, results)
    else:
        print(report(results))


if __name__ == "__main__":
    main()
