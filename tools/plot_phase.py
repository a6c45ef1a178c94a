#!/usr/bin/env python3
"""Makes the plots of docs/phase.md from figures that the program measures. Debian: python3-matplotlib, python3-pil.

usage: plot_phase.py PROGRAM BENCH_FOLDER OUTPUT_FOLDER
"""

import json
import math
import os
import subprocess
import sys
import tempfile

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402  (the backend must be chosen first)

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "figures"))

from scans import Scans  # noqa: E402


def chart(folder, name, title, x_label, y_label, draw):
    figure, axes = plt.subplots(figsize=(6.4, 4.0))
    draw(axes)
    axes.set_title(title)
    axes.set_xlabel(x_label)
    axes.set_ylabel(y_label)
    axes.grid(True, which="both", alpha=0.3)
    axes.legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(os.path.join(folder, name), metadata={"Date": None})
    plt.close(figure)


def stages(program, folder):
    """A row of pictures that `frangia decode` writes for a view of the paper's rig."""
    shown = (
        ("fringe-residues", "modulo 2π, residues"),
        ("fringe-modulation", "modulation"),
        ("growth", "order of growth"),
        ("regions", "regions"),
        ("fringes", "fringe orders"),
        ("absolute", "final phase"),
        ("mask", "reason of missing pixels"),
    )
    with tempfile.TemporaryDirectory() as work:
        scan, views = Scans(program).made("simulate", "bracket", "--rig", "carducci", "--views", 4), os.path.join(
            work, "stages"
        )
        subprocess.run([program, "--quiet", "decode", scan, "--view", "0", "-o", views], check=True)
        figure, all_axes = plt.subplots(1, len(shown), figsize=(14, 2.9))
        for axes, (name, title) in zip(all_axes, shown):
            picture = plt.imread(os.path.join(views, name + ".png"))
            axes.imshow(picture[190:460, 155:360], interpolation="nearest")
            axes.set_title(title, fontsize=9)
            axes.axis("off")
        figure.tight_layout(pad=0.4)
        figure.savefig(
            os.path.join(folder, "stages.png"),
            dpi=110,
            bbox_inches="tight",
            pad_inches=0.05,
            metadata={"Software": None},
        )
        plt.close(figure)


def noise_points(program):
    """RMS phase error against sigma_I / B for each algorithm: plates simulated at five exposures, compared with the
    same plate without noise."""
    import numpy as np
    from PIL import Image

    per_count = 20000 / 255  # electrons, the default of `frangia simulate`

    def image(path):
        return np.asarray(Image.open(path), dtype=float)

    with tempfile.TemporaryDirectory() as work:

        def decoded(scan, algorithm):
            out = os.path.join(work, "stages")
            subprocess.run(
                [program, "--quiet", "decode", scan, "--algorithm", algorithm, "--max-sigma", "2", "-o", out],
                check=True,
            )
            return image(os.path.join(out, "p20-wrapped.tiff")), image(os.path.join(out, "p20-modulation.tiff"))

        def simulated(*options):
            return Scans(program).made("simulate", "plate", "--views", 1, *options)

        exact = simulated("--no-noise", "--bits", 16)
        noisy = [simulated("--exposure", level) for level in (0.06, 0.12, 0.25, 0.5, 1)]
        points = {}
        for algorithm in ("least-squares", "global-carre", "carre"):
            truth = decoded(exact, "least-squares")[0]
            for scan in noisy:
                phase, modulation = decoded(scan, algorithm)
                mean = sum(image(os.path.join(scan, "views/000", f"p20-{k}.png")) for k in range(4)) / 4
                error = np.angle(np.exp(1j * (phase - truth)))
                sigma = np.sqrt(np.maximum(mean, 0) / per_count + (8 / per_count) ** 2 + 1 / 12)
                known = np.isfinite(error) & (modulation > 4)
                share = np.median(sigma[known] / modulation[known])
                near = known & (abs(np.log(sigma / modulation / share)) < 0.05)
                points.setdefault(algorithm, []).append((share, float(np.sqrt(np.mean(error[near] ** 2)))))
    return points


def main(program, bench, folder):
    os.makedirs(folder, exist_ok=True)
    stages(program, folder)
    table = json.loads(
        subprocess.run([program, "--json", "algorithms"], check=True, capture_output=True, text=True).stdout
    )

    def ripple(axes):
        for row in table:
            if row["ripple_by_percent"] and max(row["ripple_by_percent"]) > 1e-9:
                axes.semilogy(
                    range(-10, 11), [max(value, 1e-8) for value in row["ripple_by_percent"]], label=row["name"]
                )

    chart(folder, "ripple.svg", "Ripple against step error", "step error, %", "peak-to-valley phase error, rad", ripple)

    measured = noise_points(program)

    def noise(axes):
        for name, points in measured.items():
            axes.loglog(*zip(*points), "o", markersize=4, label=f"{name}, simulated")
        sigma = [0.01 * 1.2**i for i in range(20)]
        for row in table:
            if row["name"] in ("carre", "global-carre"):  # algorithms for the number of simulated frames
                axes.loglog(sigma, [row["noise_gain"] * s for s in sigma], linewidth=0.8, color="grey")
        axes.loglog(sigma, [math.sqrt(2 / 4) * s for s in sigma], "k--", label="Cramér-Rao bound, 4 frames")

    chart(folder, "noise.svg", "Phase error against noise", "sigma_I / B", "sigma_phi, rad", noise)

    def failure(axes):
        sigma = [0.02 + 0.005 * i for i in range(100)]
        for ratio in (2, 4, 8, 16):
            axes.semilogy(
                sigma,
                [max(1e-12, math.erfc(math.pi / (s * math.sqrt(2 * (1 + ratio**2))))) for s in sigma],
                label=f"ratio {ratio}",
            )
        axes.axhline(1e-6, color="k", linestyle=":", label="1e-6")

    chart(
        folder,
        "wrong-order.svg",
        "Probability of a wrong order against sigma",
        "sigma of each map, rad",
        "probability per pixel and level",
        failure,
    )
    path = os.path.join(bench, "phase.json")
    if not os.path.exists(path):
        print(f"{path} is missing; run ./run bench to plot the speed")
        return
    with open(path, encoding="utf-8") as file:
        runs = json.load(file)["benchmarks"]

    def speed(axes):
        for start in ("decode/schwider", "decode_maps/doubling", "unwrap_space"):
            some = [run for run in runs if run["name"].startswith(start + "/")]
            sizes = [int(run["name"].rsplit("/", 1)[1]) for run in some]
            axes.loglog(sizes, [run["cpu_time"] / size for run, size in zip(some, sizes)], "o-", label=start)

    chart(folder, "speed.svg", "Speed against size, one core", "Mpx", "ns per pixel", speed)


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
