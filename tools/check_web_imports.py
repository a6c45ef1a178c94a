#!/usr/bin/env python3
"""Checks that no source of web/src imports itself by way of others, and that each step of the app is a folder with a name.

Imports of types count: what a file knows of another is a dependency, whether or not it is loaded.
"""

import pathlib
import re
import sys

IMPORT = re.compile(r"^(?:import|export)\b[^;'\"]*?(?:from\s+)?'(\.[^']+)'", re.M)
NAMES = re.compile(r"STEP_NAMES = \[(.*?)\]", re.S)


def imports_of(path):
    for name in IMPORT.findall(path.read_text()):
        for file in (path.parent / f"{name}.ts", path.parent / name / "index.ts"):
            if file.exists():
                yield file.resolve()


def circle_in(graph):
    """The files of one circle in their order; None without one."""
    state = {}

    def visit(file, way):
        state[file] = "open"
        for other in graph[file]:
            if state.get(other) == "open":
                return [*way[way.index(other) :], other] if other in way else [file, other]
            if other not in state and (found := visit(other, [*way, other])):
                return found
        state[file] = "done"
        return None

    for file in graph:
        if file not in state and (found := visit(file, [file])):
            return found
    return None


def main():
    source = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".").resolve() / "web/src"
    graph = {path: list(imports_of(path)) for path in sorted(source.rglob("*.ts"))}
    faults = []
    if circle := circle_in(graph):
        faults.append("a circle of imports: " + " -> ".join(str(file.relative_to(source)) for file in circle))
    names = set(re.findall(r"'(\w+)'", NAMES.search((source / "step_names.ts").read_text()).group(1)))
    folders = {path.parent.name for path in source.glob("steps/*/index.ts")}
    for name in sorted(names ^ folders):
        where = "no folder of steps" if name in names else "no name in STEP_NAMES"
        faults.append(f"the step {name} has {where}")
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.setrecursionlimit(5000)
    sys.exit(main())
