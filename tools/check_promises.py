"""Checks that each promise of docs/reliability.md and docs/service-api.md names its test: check_promises.py ROOT

In the sections of PROMISES each paragraph and each point of a list names a suite of `tests`, a study of `./run faults` or a
test of the app; tables, code, and paragraphs that begin or end as WITHOUT states are left out. Every name in backquotes that
looks like a suite or a test exists. Prints one line for each fault and ends with 1 where there is one.
"""
import pathlib
import re
import sys

PROMISES = {
    "reliability.md": ["Light and motion", "A scan folder", "The app", "Files from elsewhere", "Work and memory"],
    "service-api.md": [
        "Who may ask",
        "From other machines",
        "Revisions and versions",
        "Live state",
        "A project on the disk",
    ],
}
WITHOUT = re.compile(r"^(Not promised:|The guardian cannot help)|:$")
SUITE = re.compile(r"[A-Z][a-z0-9]+[A-Za-z0-9]*[A-Z][A-Za-z0-9]*")


def known_tests(root):
    """Suites, studies and tests of the app and of scripts."""
    known = set()
    for path in (root / "tests").glob("*/*_test.cpp"):
        known |= set(re.findall(r"(?m)^TEST(?:_[FP])?\((\w+),", path.read_text()))
    known |= {path.stem for path in (root / "tests" / "faults").glob("*.py")}
    cmake = (root / "tests" / "CMakeLists.txt").read_text()
    known |= set(re.findall(r"add_test\(NAME ([\w.]+)", cmake))
    for group in re.findall(r"foreach\((?:story|name) ([^)]*)\)", cmake):
        known |= {f"app.{name}" for name in group.split()}
    return known | {"app.robust", "fuzz.replay"}


def paragraphs(text):
    """(section, text) of each paragraph and point, without tables and code."""
    section, found = "", []
    for block in re.split(r"\n\s*\n", re.sub(r"(?s)```.*?```|<!--.*?-->", "", text)):
        for part in re.split(r"(?m)^(?=- |\* |#)", block):
            part = " ".join(part.split())
            if part.startswith("#"):
                section = part.lstrip("# ")
            elif part and not part.startswith("|"):
                found.append((section, part))
    return found


def main():
    root = pathlib.Path(sys.argv[1])
    known = known_tests(root)
    faults = []
    for page, sections in PROMISES.items():
        text = (root / "docs" / page).read_text()
        missing = set(sections) - {section for section, _ in paragraphs(text)}
        faults += [f"docs/{page}: there is no section '{section}'" for section in sorted(missing)]
        for section, part in paragraphs(text):
            names = re.findall(r"`([\w.]+)`", part)
            if section in sections and not WITHOUT.search(part) and not known.intersection(names):
                faults.append(f"docs/{page}: no test is named for: {part[:100]}")
            for name in names:
                looks = SUITE.fullmatch(name) or re.fullmatch(r"app\.\w+|fuzz\.\w+", name)
                if looks and name not in known and name not in ("PixelStatus",):
                    faults.append(f"docs/{page}: there is no test '{name}'")
    print("\n".join(faults))
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
