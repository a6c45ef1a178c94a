#!/usr/bin/env python3
"""The plot of docs/surface.md: how the time of pasting grows. Debian: python3-matplotlib.

usage: plot_paste.py BENCH_FOLDER PLOT.svg    the folder holds paste_views.json, as `./run bench` leaves it
"""
import json
import math
import pathlib
import sys

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402  (the backend comes first)


def points(runs, name):
    """(argument, seconds) of the runs of one benchmark."""
    mine = [run for run in runs if run["name"].startswith(name + "/")]
    return [(float(run["name"].split("/")[1]), run["least_s"]) for run in mine]


def draw(axes, values, label):
    """The points, and the straight line that fits best."""
    xs, ys = zip(*values)
    mean_x, mean_y = sum(xs) / len(xs), sum(ys) / len(ys)
    slope = sum((x - mean_x) * (y - mean_y) for x, y in values) / sum((x - mean_x) ** 2 for x in xs)
    ends = [0, max(xs)]
    axes.plot(ends, [mean_y + slope * (x - mean_x) for x in ends], color="0.6", linewidth=1, label="straight line")
    axes.plot(xs, ys, "o", label="measured")
    axes.set_xlim(0)
    axes.set_ylim(0)
    axes.set_xlabel(label)
    axes.set_ylabel("s")
    axes.grid(True, alpha=0.3)
    axes.legend(fontsize=8)


def main(bench, plot):
    runs = json.loads((bench / "paste_views.json").read_text())["benchmarks"]
    figure, (left, right) = plt.subplots(1, 2, figsize=(8.4, 3.4))
    draw(left, points(runs, "paste_by_views"), "views of one sphere")
    areas = [(4 * math.pi * radius**2 * 1e-2, seconds) for radius, seconds in points(runs, "paste_by_radius")]
    draw(right, areas, "surface of the sphere, cm²")
    figure.tight_layout()
    figure.savefig(plot, metadata={"Date": None})


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))
