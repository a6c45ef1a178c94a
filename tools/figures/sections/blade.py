"""A blade that is bent at its tip against the nominal one, and how often a good one is called bad."""
import shutil

import numpy

from alignment import write_moved
from surfaces import points_of, read_ply, read_triangles

TITLE = "A bent blade, and good ones"
PAGE = "inspection.md"

SEEDS = 100
BEND_MM = 0.1
TOLERANCE_MM = 0.05


def bent(study, nominal):
    """The nominal blade with its tip moved along x, growing with the square of the height."""
    path = study.work / "blade-bent.ply"
    vertices, triangles = read_ply(nominal).copy(), read_triangles(nominal)
    vertices["x"] += (BEND_MM * (vertices["z"] / vertices["z"].max()) ** 2).astype("f4")
    write_moved(path, vertices, triangles, numpy.eye(3), numpy.zeros(3))
    return path


def measured(study, part, seed, nominal):
    """The answer about the mesh of a scan, and that mesh with its deviations; the scan is deleted."""
    name = f"blade-{part.stem if hasattr(part, 'stem') else part}-{seed}"
    mesh = study.work / f"{name}.ply"
    if not mesh.exists():
        scan = study.made(f"{name}-scan", "simulate", part, "--seed", seed)
        study.run("reconstruct", scan, "-o", mesh)
        shutil.rmtree(scan)
    out = study.work / "blade-deviations.ply"
    return (
        study.run("inspect", mesh, "--reference", nominal, "--align", "none", "--tolerance", TOLERANCE_MM, "-o", out)[
            "deviation"
        ],
        out,
    )


def measure(study):
    nominal = study.made("blade-nominal", "simulate", "blade", "--views", 1) / "truth.ply"
    study.add(
        f"The simulated blade, digital rig; `frangia inspect MESH.ply --reference blade.ply --tolerance {TOLERANCE_MM}`.\n"
    )
    found, out = measured(study, bent(study, nominal), 1, nominal)
    vertices = read_ply(out)
    points, deviation, u = points_of(vertices), vertices["deviation_mm"], vertices["u_mm"]
    height = points[:, 2].max()
    expected = BEND_MM * (points[:, 2] / height) ** 2 * vertices["nx"]
    tip = (points[:, 2] > 0.9 * height) & (numpy.abs(vertices["nx"]) > 0.7) & numpy.isfinite(deviation)
    error = deviation[tip] - expected[tip]
    study.table("a blade bent by 0.1 mm at its tip", "measured", "wanted")
    study.row("verdict", found["verdict"], "out")
    study.row(
        "mean deviation of the tip's faces along their normals, mm",
        f"{numpy.mean(numpy.sign(vertices['nx'][tip]) * deviation[tip]):.4f}",
        f"{numpy.mean(numpy.abs(expected[tip])):.4f}",
    )
    study.row(
        "error of a vertex over its uncertainty, RMS", f"{numpy.sqrt(numpy.mean((error / u[tip]) ** 2)):.2f}", "about 1"
    )
    verdicts = [measured(study, "blade", seed, nominal)[0]["verdict"] for seed in range(1, SEEDS + 1)]
    study.add(
        f"\nGood blades, {SEEDS} seeds: {verdicts.count('out')} called out (the rule allows {SEEDS * 5 // 100}), "
        f"{verdicts.count('undecided')} undecided, {verdicts.count('in')} in."
    )
