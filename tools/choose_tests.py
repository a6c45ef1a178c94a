"""Chooses what `./run test` runs: choose_tests.py ROOT NAME...  or, with changed paths as lines of input, choose_tests.py ROOT --changed

A group of tests is the first word of their names: a module (tests/MODULE/*_test.cpp), `apps`, or one of SCRIPTS; the CMake
target tests_GROUP builds what it needs. Prints two lines: the groups whose tests run in full, and those of which the tests
labelled `chain` run. Ends with 2 and one sentence where a name is unknown.
"""
import pathlib
import re
import sys

from module_statement import module_uses

SCRIPTS = ("app", "docs", "faults", "fuzz", "python", "tools")
# Paths that belong to no module, and the groups whose tests run in full when one of them changes.
FOLDERS = {
    "apps": ["apps"],
    "web": ["app"],
    "python": ["python"],
    "docs": ["docs"],
    "fuzz": ["fuzz"],
    "tools": ["tools"],
    "run": ["tools"],
    "benchmarks": [],
    "README.md": ["docs"],
    "CHANGELOG.md": [],
    "CONTRIBUTING.md": [],
    "LICENSE": [],
    "NOTICE": [],
}


def groups_of(root):
    """All groups, sorted."""
    compiled = {path.parent.name for path in (root / "tests").glob("*/*_test.cpp")}
    return sorted(compiled | set(SCRIPTS))


def groups_with_chain(root):
    """The groups of the tests that tests/chain_tests.txt names."""
    lines = (root / "tests" / "chain_tests.txt").read_text().splitlines()
    return {line.split(".")[0] for line in lines if line and not line.startswith("#")}


def choose_named(root, names):
    """The groups that are named, also as test programs (test_phase). Raises ValueError for a name that is none."""
    known = groups_of(root)
    chosen = [name.removeprefix("test_") for name in names]
    for name in chosen:
        if name not in known:
            raise ValueError(f"there is no test '{name}'; the tests are {', '.join(known)}")
    return sorted(set(chosen))


def dependents(uses, modules):
    """The modules that use one of `modules`, directly or through others."""
    found = set(modules)
    for module, used in uses.items():  # a module is stated after those that it uses
        if found.intersection(used):
            found.add(module)
    return found - set(modules)


def groups_that_read(root, name):
    """The groups whose files name a file of tests/support or tests/data, directly or through a header of tests/support."""
    names, groups = {name}, set()
    support = {path.name: path.read_text() for path in (root / "tests" / "support").glob("*.h")}
    while grown := {
        header for header, text in support.items() if header not in names and any(one in text for one in names)
    }:
        names |= grown
    for path in (root / "tests").glob("*/*"):
        if path.suffix in (".cpp", ".h", ".py", ".mjs", ".sh") and path.parent.name != "support":
            text = path.read_text()
            if any(re.search(rf"\b{re.escape(one)}\b", text) for one in names):
                groups.add(path.parent.name)
    return groups


def choose_changed(root, paths):
    """The groups that run in full and those of which the chain runs, for paths relative to `root` that changed."""
    known, uses = set(groups_of(root)), module_uses(root)
    full, modules, everything = set(), set(), False
    for path in paths:
        parts = pathlib.PurePosixPath(path).parts
        if parts[:2] == ("src", "frangia") and parts[2] in uses:
            modules.add(parts[2])
        elif parts[0] == "tests" and len(parts) > 2:
            full |= groups_that_read(root, parts[2]) if parts[1] in ("support", "data") else {parts[1]}
        elif parts[0] == "tests" and path.endswith(".sh"):
            full.add("tools")
        elif parts[0] in FOLDERS:
            full.update(FOLDERS[parts[0]])
        else:  # the build, the examples and what is not known
            everything = True
    full = (full | modules) & known
    depend = known if everything else set()
    if modules or "apps" in full:  # the program and the Python package are made of all modules
        depend = depend | dependents(uses, modules) | set(SCRIPTS) | {"apps"}
    return sorted(full), sorted(depend & groups_with_chain(root) - full)


def main():
    root, *names = sys.argv[1:]
    root = pathlib.Path(root)
    try:
        full, chain = (
            choose_changed(root, sys.stdin.read().split("\n")[:-1])
            if names == ["--changed"]
            else (choose_named(root, names), [])
        )
    except ValueError as error:
        print(f"run: {error}", file=sys.stderr)
        sys.exit(2)
    print(" ".join(full), " ".join(chain), sep="\n")


if __name__ == "__main__":
    main()
