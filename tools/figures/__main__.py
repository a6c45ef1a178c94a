"""Measures the figures of the documentation: python3 tools/figures PROGRAM [NAME...] [--full] [--again], or `./run figures`.

Each section is a file of `sections` and one part of a page in docs; a section that is not named, or that needs something
missing on this machine, stays as it is. Without names all are measured; `changed` stands for those whose inputs changed
since they were measured last, `list` prints them with the time, the revision and the state of the last measurement.

--full   all cases of a section; otherwise a fixed part of them, of at most ten minutes on two idle cores
--again  measures also the cases whose results by the same inputs are known, which an interrupted measurement goes on with
--names  prints the names of the sections that would be measured

PROGRAM is the program that the sources of this folder build: what is kept is known by their checksums.
"""
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE / "sections"), str(HERE.parent)]

from measure import cases_of, expected_s, importlib, is_changed, measure, read_record, time_text  # noqa: E402
from scans import Scans  # noqa: E402
from table import SECTIONS  # noqa: E402

OPTIONS = ("--full", "--again", "--names")


def times_of(name):
    """The expected time of the part and, where it is longer, of the full measurement."""
    try:
        section = importlib.import_module(name)
    except ImportError as error:  # `list` installs nothing
        return [f"needs {error.name}", ""]
    part, every = (len(cases_of(section, name, is_full)) for is_full in (False, True))
    return [time_text(expected_s(name, False, part)), time_text(expected_s(name, True, every)) if every > part else ""]


def print_list():
    rows = [("section", "time", "--full", "measured at", "in full at", "")]
    for name in SECTIONS:
        entry = read_record().get(name, {})
        at = [entry.get(kind, {}).get("revision", "never") for kind in ("part", "full")]
        rows.append((name, *times_of(name), *at, "changed" if is_changed(name, False) else ""))
    widths = [max(map(len, column)) for column in zip(*rows)]
    print("\n".join("  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip() for row in rows))


def chosen(words, is_full):
    """The sections that the words of the command line name."""
    names = []
    for word in words or SECTIONS:
        if word != "changed" and word not in SECTIONS:
            sys.exit(
                f"figures: there is no section '{word}'; the sections are {', '.join(SECTIONS)}; 'changed' stands for those whose inputs changed"
            )
        names += [name for name in SECTIONS if is_changed(name, is_full)] if word == "changed" else [word]
    return list(dict.fromkeys(names))


def main(program, words):
    options = [word for word in words if word.startswith("-")]
    unknown = [option for option in options if option not in OPTIONS]
    if unknown:
        sys.exit(f"figures: there is no option '{unknown[0]}'; the options are {', '.join(OPTIONS)}")
    if words == ["list"]:
        return print_list()
    is_full = "--full" in options
    names = chosen([word for word in words if word not in options], is_full)
    if "--names" in options:
        return print(" ".join(names))
    if not names:
        return print("figures: no section has changed inputs")
    Scans(program).remove_stale()
    try:
        failed = [name for name in names if not measure(program, name, is_full, "--again" in options)]
    except KeyboardInterrupt:
        sys.exit("figures: interrupted; the same command goes on with the case that was not finished")
    except subprocess.CalledProcessError as error:
        sys.exit(f"figures: {' '.join(map(str, error.cmd))} ended with {error.returncode}: {error.stderr}")
    if failed:
        sys.exit(f"figures: not as wanted: {', '.join(failed)}")


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2:])
