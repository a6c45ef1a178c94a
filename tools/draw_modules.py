"""Draws which module uses which, for docs/map.md, from the statements in CMakeLists.txt: `draw_modules.py ROOT [--check]`

Arrows that follow from others are left out: a module also uses what those that it uses do. The picture holds the graph
that it was drawn from; --check compares that with CMakeLists.txt and draws nothing.
"""
import pathlib
import subprocess
import sys

from module_statement import module_uses

PICTURE = "docs/images/modules.svg"
# The path of light, dark; what serves all stages or leads in and out of it, light.
PATH = "pattern frames phase range decode views local_fit fringe_order registration fusion mesh files".split()


def reduced(uses):
    """The arrows that no chain of others replaces."""
    all_of = {}  # everything that a module uses, also through others
    for name, direct in uses.items():
        all_of[name] = set(direct).union(*(all_of[used] for used in direct))
    return [
        (name, used)
        for name, direct in uses.items()
        for used in direct
        if not any(used in all_of[other] for other in direct if other != used)
    ]


def graph_of(root):
    uses = module_uses(root)
    lines = [
        "digraph modules {",
        '  rankdir = RL; ranksep = 0.35; nodesep = 0.12; bgcolor = "white";',
        '  node [shape = box, style = "filled,rounded", fontname = "sans-serif", fontsize = 11, height = 0.3,',
        '    color = "#5b6b68", fillcolor = "#eef2f0", margin = "0.09,0.03"];',
        '  edge [color = "#93a19d", arrowsize = 0.5];',
    ]
    lines += [f'  {name} [fillcolor = "#bfe3d3"];' for name in uses if name in PATH]
    lines += [f"  {name} -> {used};" for name, used in reduced(uses)]
    lines += [f"  {name};" for name, direct in uses.items() if not direct]
    return "\n".join([*lines, "}"])


def main(root, *options):
    picture, graph = root / PICTURE, graph_of(root)
    if "--check" in options:
        if not picture.exists() or graph not in picture.read_text():
            sys.exit(f"{PICTURE} does not show the modules of CMakeLists.txt; draw it again: ./run figures modules")
        return
    drawn = subprocess.run(["dot", "-Tsvg"], input=graph, capture_output=True, text=True, check=True).stdout
    picture.write_text(drawn.replace("<svg ", f"<!-- tools/draw_modules.py\n{graph}\n-->\n<svg ", 1))


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]), *sys.argv[2:])
