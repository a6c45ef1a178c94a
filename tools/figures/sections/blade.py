"""A blade that is bent at its tip against the nominal one, and how often a good one is called bad."""
import numpy

from alignment import write_moved
from surfaces import points_of, read_ply, read_triangles

TITLE = "A bent blade, and good ones"
PAGE = "inspection.md"

BEND_MM = 0.1
TOLERANCE_MM = 0.05
CASES = {"bent": 1, "good": 100}
PART = 40


def bent(study, nominal):
    """The nominal blade with its tip moved along x, growing with the square of the height."""
    path = study.work / "blade-bent.ply"
    vertices, triangles = read_ply(nominal).copy(), read_triangles(nominal)
    vertices["x"] += (BEND_MM * (vertices["z"] / vertices["z"].max()) ** 2).astype("f4")
    write_moved(path, vertices, triangles, numpy.eye(3), numpy.zeros(3))
    return path


def measure(study, case, seed):
    nominal = study.simulated("blade", "--views", 1) / "truth.ply"
    scan = study.simulated(bent(study, nominal) if case == "bent" else "blade", "--seed", seed)
    mesh, out = study.reconstructed(scan)[0], study.work / "deviations.ply"
    found = study.run(
        "inspect", mesh, "--reference", nominal, "--align", "none", "--tolerance", TOLERANCE_MM, "-o", out
    )["deviation"]
    return {"verdict": found["verdict"], **(deviations_of_the_tip(out) if case == "bent" else {})}


def deviations_of_the_tip(out):
    vertices = read_ply(out)
    points, deviation, u = points_of(vertices), vertices["deviation_mm"], vertices["u_mm"]
    height = points[:, 2].max()
    expected = BEND_MM * (points[:, 2] / height) ** 2 * vertices["nx"]
    tip = (points[:, 2] > 0.9 * height) & (numpy.abs(vertices["nx"]) > 0.7) & numpy.isfinite(deviation)
    error = deviation[tip] - expected[tip]
    return {
        "mean_mm": float(numpy.mean(numpy.sign(vertices["nx"][tip]) * deviation[tip])),
        "expected_mm": float(numpy.mean(numpy.abs(expected[tip]))),
        "over_u": float(numpy.sqrt(numpy.mean((error / u[tip]) ** 2))),
    }


def report(text, results):
    bent_blade, good = results["bent"][0], [one["verdict"] for one in results["good"]]
    text.add(
        f"The simulated blade, digital rig; `frangia inspect MESH.ply --reference blade.ply --tolerance {TOLERANCE_MM}`.\n"
    )
    text.table("a blade bent by 0.1 mm at its tip", "measured", "wanted")
    text.row("verdict", bent_blade["verdict"], "out")
    text.row(
        "mean deviation of the tip's faces along their normals, mm",
        f"{bent_blade['mean_mm']:.4f}",
        f"{bent_blade['expected_mm']:.4f}",
    )
    text.row("error of a vertex over its uncertainty, RMS", f"{bent_blade['over_u']:.2f}", "about 1")
    text.add(
        f"\nGood blades, {len(good)} seeds: {good.count('out')} called out (the rule allows {len(good) * 5 // 100}), "
        f"{good.count('undecided')} undecided, {good.count('in')} in."
    )
