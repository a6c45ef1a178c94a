#!/usr/bin/env python3
"""Draws the plot of docs/surface.md: time of the fusion against views and area. Debian: python3-matplotlib.

usage: plot_fusion.py BENCH_FOLDER PLOT.svg    the folder holds fuse_views.json, as `./run bench` leaves it
"""
import json
import math
import pathlib
import sys

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402  (after the choice of the backend)


def points(runs, name):
    """Returns (argument, seconds) of the runs of one benchmark."""
    of_name = [run for run in runs if run["name"].startswith(name + "/")]
    return [(float(run["name"].split("/")[1]), run["least_s"]) for run in of_name]


def draw(axes, values, label):
    """Draws the points and their least-squares line."""
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
    runs = json.loads((bench / "fuse_views.json").read_text())["benchmarks"]
    figure, (left, right) = plt.subplots(1, 2, figsize=(8.4, 3.4))
    draw(left, points(runs, "fuse_by_views"), "views of one sphere")
    areas = [(4 * math.pi * radius**2 * 1e-2, seconds) for radius, seconds in points(runs, "fuse_by_radius")]
    draw(right, areas, "area of the sphere, cm²")
    figure.tight_layout()
    figure.savefig(plot, metadata={"Date": None})


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))
