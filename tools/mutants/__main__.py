"""Changes one operator or constant of a module's sources at a time and lists the changes that the module's own tests
do not notice:

    python3 tools/mutants BUILD_TREE MODULE [N] [--seed S] [--all] [--base REVISION]

N changes (20) are drawn by the seed (1) from the lines that changed since the revision, with --all from all lines. A
change that does not compile, gives the same object, or is listed in equivalent.txt is replaced by the next of the seed.
The exit code is 1 where more than 15 % survive. It works in BUILD_TREE/mutants/MODULE and leaves nothing there."""
import argparse
import fcntl
import json
import pathlib
import random
import re
import shutil
import signal
import subprocess
import sys

import sites
from build_tree import BuildTree, Unusable

ROOT = pathlib.Path(__file__).resolve().parents[2]
MOST_SURVIVORS = 0.15
QUICK_S = 0.3  # tests up to this run before the others
SLOWDOWN = 5  # processor time of a changed program against time of the unchanged, which is optimized more


def changed_lines(base, path):
    """The numbers of the lines of a source that differ from a revision, committed or not."""
    diff = subprocess.run(["git", "diff", "-U0", base, "--", path], cwd=ROOT, capture_output=True, text=True)
    if diff.returncode:
        raise Unusable(f"git cannot compare {path} with '{base}': {diff.stderr.strip()}")
    numbers = set()
    for begin, count in re.findall(r"^@@ -\S+ \+(\d+)(?:,(\d+))? @@", diff.stdout, re.M):
        numbers.update(range(int(begin), int(begin) + int(count or 1)))
    return numbers


class Change:
    """One change of one source, by its site and the seed's choice there."""

    def __init__(self, site, text, rng):
        self.path, self.source = site.path, text
        self.text = text[: site.start] + rng.choice(site.choices) + text[site.end :]
        self.line = text.count("\n", 0, site.start) + 1
        self.before = text.splitlines()[self.line - 1].strip()
        self.after = self.text.splitlines()[self.line - 1].strip()

    def __str__(self):
        return f"{self.path}:{self.line}\n  - {self.before}\n  + {self.after}"


def draw(module, seed, base):
    """All changes in the order of the seed; the texts of sources are those of now."""
    found, texts = [], {}
    for source in sorted((ROOT / "src/frangia" / module).rglob("*.cpp")):
        path = str(source.relative_to(ROOT))
        texts[path] = source.read_text()
        lines = None if base is None else changed_lines(base, path)
        found += [
            site
            for site in sites.sites(path, texts[path])
            if lines is None or texts[path].count("\n", 0, site.start) + 1 in lines
        ]
    rng = random.Random(f"{module} {seed}")
    rng.shuffle(found)
    return [Change(site, texts[site.path], rng) for site in found]


def read_equivalent():
    """Changes that no result shows, as (path, before, after)."""
    known, path, before = set(), None, None
    for line in pathlib.Path(__file__).with_name("equivalent.txt").read_text().splitlines():
        if line.startswith("src/"):
            path = line.strip()
        elif line.startswith("  - "):
            before = line[4:]
        elif line.startswith("  + "):
            known.add((path, before, line[4:]))
    return known


class Tests:
    """The module's tests in the order in which they run: those about the source, the quick ones, the others."""

    def __init__(self, tree):
        self.tree = tree
        program = tree.built_program
        self.sources = tree.tests(program)
        report = tree.work / "unchanged.json"
        passed, self.cpu_s, output = tree.run(program, ["*"], 3600, f"--gtest_output=json:{report}")
        if not passed:
            raise Unusable(f"the tests of {tree.module} fail without a change:\n{output[-2000:]}")
        self.seconds = {
            f"{suite['name']}.{test['name']}": float(test["time"].rstrip("s"))
            for suite in json.loads(report.read_text())["testsuites"]
            for test in suite["testsuite"]
        }
        self.texts = {path: path.read_text() for path in set(self.sources.values())}

    def passes(self, path):
        header = path.removeprefix("src/").removesuffix(".cpp") + ".h"
        stem = pathlib.Path(path).stem
        about = [
            name
            for name, source in self.sources.items()
            if source.stem.startswith(stem) or f'"{header}"' in self.texts[source]
        ]
        others = set(self.sources) - set(about)
        quick = [name for name in self.sources if name in others and self.seconds.get(name, 0) <= QUICK_S]
        slow = [name for name in self.sources if name in others and self.seconds.get(name, 0) > QUICK_S]
        return [names for names in (about, quick, slow) if names]

    def killer(self, path):
        """What notices the change with which the program is linked: a test's name, or None."""
        for names in self.passes(path):
            limit_s = 5 + SLOWDOWN * sum(self.seconds.get(name, 0) for name in names)
            passed, _, output = self.tree.run(self.tree.program, names, limit_s, "--gtest_fail_fast")
            if not passed:
                failed = re.search(r"\[  FAILED  \] (\S+?),? ", output)
                return failed[1] if failed else "a crash or a limit"
        return None


def try_changes(tree, changes, count):
    """The numbers of changes that were tried, and the survivors."""
    tests = Tests(tree)
    print(
        f"{len(tests.sources)} tests of {tree.module} take {tests.cpu_s:.1f} s of processor time without a change",
        flush=True,
    )
    equivalent, unchanged = read_equivalent(), {}
    tried, known, survivors = 0, 0, []
    for change in changes:
        if tried == count:
            break
        if change.path not in tree.commands:  # of a part that this build leaves out
            continue
        if (change.path, change.before, change.after) in equivalent:
            known += 1
            continue
        if change.path not in unchanged:
            unchanged[change.path] = tree.compile(change.path, change.source)
            if unchanged[change.path] is None:
                raise Unusable(f"{change.path} does not compile as it is")
        compiled = tree.compile(change.path, change.text)
        if compiled is not None and compiled != unchanged[change.path] and tree.link():
            tried += 1
            killer = tests.killer(change.path)
            if killer is None:
                survivors.append(change)
            print(f"{tried:3d} {'killed by ' + killer if killer else 'SURVIVES'}: {change}", flush=True)
        (tree.source_root.parent / change.path).write_text(change.source)
    return tried, known, survivors


def interrupt(*_):
    raise KeyboardInterrupt


def main():
    parser = argparse.ArgumentParser(prog="mutants", description="Changes that a module's tests do not notice.")
    parser.add_argument("tree", type=pathlib.Path)
    parser.add_argument("module")
    parser.add_argument("count", nargs="?", type=int, default=20, metavar="N")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--all", action="store_true", help="in all lines, not only in those that changed")
    parser.add_argument("--base", default="HEAD", help="the revision since which lines changed")
    options = parser.parse_args()
    if not (ROOT / "src/frangia" / options.module).is_dir():
        sys.exit(f"mutants: there is no module '{options.module}' in src/frangia")
    changes = draw(options.module, options.seed, None if options.all else options.base)
    if not changes:
        print(f"nothing to change in {options.module} since {options.base}; --all takes all lines")
        return
    tree = options.tree.resolve()
    work = tree / "mutants" / options.module
    work.parent.mkdir(exist_ok=True)
    signal.signal(signal.SIGTERM, interrupt)
    with (work.parent / f"{options.module}.lock").open("w") as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            sys.exit(f"mutants: another run changes {options.module} in {tree}; wait for its end")
        try:
            shutil.rmtree(work, ignore_errors=True)
            work.mkdir()
            tried, known, survivors = try_changes(BuildTree(ROOT, tree, work, options.module), changes, options.count)
        except Unusable as problem:
            sys.exit(f"mutants: {problem}")
        except KeyboardInterrupt:
            print("mutants: interrupted", file=sys.stderr)
            sys.exit(130)
        finally:
            shutil.rmtree(work, ignore_errors=True)
    if survivors:
        print("\nSurvivors: each needs a test, or its reason in tools/mutants/equivalent.txt")
        print(*survivors, sep="\n")
    print(
        f"\n{options.module}, seed {options.seed}: {tried - len(survivors)} of {tried} changes killed, "
        f"{len(survivors)} survive; {known} known as equivalent left out"
    )
    if len(survivors) > MOST_SURVIVORS * tried:
        sys.exit(f"mutants: more than {MOST_SURVIVORS:.0%} survive")


if __name__ == "__main__":
    main()
