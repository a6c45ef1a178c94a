"""Counts the internal headers with fewer than two users: `count_internal_headers.py ROOT [--list]`

A user is a file that includes the header, tests, benchmarks and fuzzing among them; the header's own source is none. The
number may fall and not rise: lower MOST with it.
"""
import pathlib
import re
import sys

MOST = 46


def main(root, *options):
    sources = [
        path
        for folder in ("src", "apps", "python", "tests", "benchmarks", "fuzz")
        for path in (root / folder).rglob("*")
        if path.suffix in (".cpp", ".h")
    ]
    headers = {
        str(path.relative_to(root / "src")): path
        for path in sources
        if "internal" in path.parts and path.suffix == ".h"
    }
    users = {name: set() for name in headers}
    for path in sources:
        for name in re.findall(r'#\s*include\s*"(frangia/[^"]+)"', path.read_text()):
            if name in users and path.with_suffix("") != headers[name].with_suffix(""):
                users[name].add(path)
    few = sorted(name for name, found in users.items() if len(found) < 2)
    if "--list" in options:
        print(*few, sep="\n", end="\n" if few else "")
    print(f"{len(few)} of {len(headers)} internal headers have fewer than two users")
    if len(few) > MOST:
        sys.exit(f"there were {MOST}; give a new header two users (a test counts), or put it into its user's source")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]), *sys.argv[2:])
