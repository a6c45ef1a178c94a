"""How often the U95 of sizes, distances and positions covers their errors when the noise and the rig are drawn."""
import csv
import json
import os
import shutil
import tomllib

import cv2
import numpy

TITLE = "Sizes by rigs that are drawn from their covariance"
PAGE = "inspection.md"

POSES = 12
CASES = {"ball-bar": 20, "bracket": 20, "shaft": 20}
PART = 2
LEAST, MOST = 92, 98  # percent that are covered
WIDEST = 1.3  # U95 over 1.96 times the spread

# Name, kind, place and nominal diameter of features; two features and their distance; features whose position counts.
PLANS = {
    "ball-bar": (
        [
            ("ball 1", "sphere", [0, 35, 60], 40),
            ("ball 2", "sphere", [0, -35, 60], 40),
            ("post 1", "cylinder", [0, 35, 25], 14),
            ("post 2", "cylinder", [0, -35, 25], 14),
            ("base", "plane", [0, 0, 8], None),
        ],
        [("ball 1", "ball 2", 70), ("post 1", "post 2", 70), ("ball 1", "base", 52), ("ball 2", "base", 52)],
        ["ball 1", "ball 2"],
    ),
    "bracket": (
        [
            ("left", "plane", [-30, 0, 32], None),
            ("inner", "plane", [-22, 0, 27], None),
            ("top", "plane", [-11, 0, 70], None),
            ("foot", "plane", [2, 0, 8], None),
            ("front", "plane", [-11, 25, 34], None),
            ("back", "plane", [-11, -25, 34], None),
            ("bore", "cylinder", [-6, 0, 66], 14),
            ("hole", "cylinder", [18, -14, 4], 10),
        ],
        [("inner", "left", 8), ("top", "foot", 62), ("front", "back", 50)],
        ["bore", "hole"],
    ),
    "shaft": (
        [
            ("journal", "cylinder", [0, 0, 58], 36),
            ("end", "cylinder", [0, 0, 91], 28),
            ("flange", "cylinder", [0, 0, 29], 52),
            ("shoulder", "plane", [0, 0, 38], None),
            ("step", "plane", [0, 0, 80], None),
            ("face", "plane", [0, 0, 100], None),
        ],
        [("face", "step", 20), ("face", "shoulder", 62), ("step", "shoulder", 42)],
        [],
    ),
}


def table(heading, **values):
    """A table of an array in a plan."""
    return f"[[{heading}]]\n" + "".join(f"{key} = {json.dumps(value)}\n" for key, value in values.items())


def plan_of(part, truth):
    features, distances, positions = PLANS[part]
    text = (
        f'format = "frangia-inspection"\nversion = 1\nreference = "{truth}"\nalign = "best-fit"\nstart = 1\n'
        "tolerance_mm = [-1, 1]\n"
    )
    for name, kind, near, diameter in features:
        size = {"diameter_mm": diameter, "tolerance_mm": [-1, 1]} if diameter else {}
        text += table("features", name=name, kind=kind, near_mm=near, **size)
    for one, other, nominal in distances:
        text += table(
            "characteristics",
            name=f"{one} to {other}",
            kind="distance",
            feature=one,
            datum=other,
            nominal=nominal,
            tolerance=[-1, 1],
        )
    places = {name: near for name, _, near, _ in features}
    for name in positions:
        text += table(
            "characteristics",
            name=f"{name} position",
            kind="position",
            feature=name,
            position_mm=places[name],
            limit=1,
        )
    return text


def with_other_rig(study, scan, covariance, seed):
    """A copy of a scan whose rig.toml is drawn about the one that rendered it, with the covariance that it is drawn from."""
    folder = study.fresh("scan")
    shutil.copytree(scan, folder, copy_function=os.link)
    rows = list(csv.reader(covariance.read_text().splitlines()))
    random = numpy.random.default_rng([50, seed])
    matrix = numpy.array([row[1:] for row in rows[1:]], float)
    change = dict(zip(rows[0][1:], random.multivariate_normal(numpy.zeros(len(matrix)), matrix, method="eigh")))
    text = (scan / "rig.toml").read_text()
    rig = tomllib.loads(text)
    rotation = numpy.array(rig["projector"]["rotation"])
    shift = -rotation @ numpy.array(rig["projector"]["position_mm"])
    turn = cv2.Rodrigues(rotation)[0][:, 0] + [change[f"projector.rotation_{axis}_rad"] for axis in "xyz"]
    shift = shift + [change[f"projector.{axis}_mm"] for axis in "xyz"]
    turned = cv2.Rodrigues(turn)[0]
    drawn = {("projector", "rotation"): turned.tolist(), ("projector", "position_mm"): (-turned.T @ shift).tolist()}
    for device in ("camera", "projector"):
        known = rig[device]
        focal = known["focal_px"][0] + change[f"{device}.focal_px"]
        ratio = known["focal_px"][1] / known["focal_px"][0] + change[f"{device}.focal_ratio"]
        drawn[device, "focal_px"] = [focal, focal * ratio]
        drawn[device, "principal_point_px"] = [
            value + change[f"{device}.principal_{axis}_px"] for value, axis in zip(known["principal_point_px"], "xy")
        ]
        drawn[device, "distortion"] = [
            value + change[f"{device}.{term}"]
            for value, term in zip(known["distortion"], ("k1", "k2", "p1", "p2", "k3"))
        ]
    section, lines = "", []
    for line in text.splitlines():
        section = line.strip("[]") if line.startswith("[") else section
        key = line.split("=")[0].strip()
        if section == "turntable" and "_sigma_" in key:
            continue  # the rendering rig states its turntable as exact, which that of a drawn rig is not
        lines.append(f"{key} = {json.dumps(drawn[section, key])}" if (section, key) in drawn else line)
    (folder / "rig.toml").unlink()
    calibration = '\n[calibration]\ndate = "2026-12-01"\ncovariance = "rig-covariance.csv"\n'
    (folder / "rig.toml").write_text("\n".join(lines) + "\n" + calibration)
    shutil.copy(covariance, folder / "rig-covariance.csv")
    return folder


def covariance_of(study):
    """The covariance of the rig as a board calibrates it, about the file of its rig."""
    board = ("--calibration", "charuco", "--views", POSES, "--rig", study.half_rig, "--samples", 9, "--seed", 1)
    rig = study.work / "calibrated.toml"
    if not rig.exists():
        study.run("calibrate", "rig", study.simulated(*board), "-o", rig)
    return rig.parent / tomllib.loads(rig.read_text())["calibration"]["covariance"]


def measure(study, case, seed):
    covariance = covariance_of(study)
    scan = study.digital(case, study.half_rig, "--seed", seed)
    drawn = with_other_rig(study, scan, covariance, seed)
    mesh, plan = study.work / "mesh.ply", study.work / "inspection.toml"
    answer = study.run("reconstruct", drawn, "-o", mesh, allowed=(0, 4, 5))
    plan.write_text(plan_of(case, scan / "truth.ply"))
    found = study.run("inspect", mesh, "--plan", plan, "--scan", drawn)
    return {
        "trustworthy": answer["trustworthy"],
        "sizes": {
            row["name"]: [row["value"] - (row["nominal"] or 0), row["u95"]]
            for row in found["characteristics"]
            if row["value"] is not None and row["u95"] is not None
        },
    }


def report(text, results):
    text.add(
        f"A board of {POSES} poses calibrates the digital rig with half the pixels. Each seed draws the noise of a scan of eight views, and a rig "
        "from that covariance; the rig and the covariance are those of the scan, its turntable states no standard deviations. "
        "`frangia reconstruct SCAN -o MESH.ply`, `frangia inspect MESH.ply --plan inspection.toml --scan SCAN`. A position covers when "
        "its value is within its U95.\n"
    )
    text.table(
        "part",
        "size, distance or position, mm",
        "found",
        "covered",
        "mean error, mm",
        "spread, mm",
        "mean U95, mm",
        "U95 over 1.96 spread",
    )
    covered = total = 0
    ratios = []
    for part, seeds in results.items():
        names = list(dict.fromkeys(name for one in seeds for name in one["sizes"]))
        for name in names:
            error, u95 = numpy.array([one["sizes"][name] for one in seeds if name in one["sizes"]]).T
            inside = int((abs(error) <= u95).sum())
            covered, total = covered + inside, total + len(error)
            spread = error.std(ddof=1) if len(error) > 1 else numpy.nan
            ratio = u95.mean() / (1.96 * spread)
            if not name.endswith("position"):
                ratios.append(ratio)
            text.row(
                part,
                name,
                len(error),
                inside,
                f"{error.mean():+.4f}",
                f"{spread:.4f}",
                f"{u95.mean():.4f}",
                f"{ratio:.2f}",
            )
    doubted = sum(not one["trustworthy"] for seeds in results.values() for one in seeds)
    text.add(
        f"\nPooled: {covered} of {total} ({100 * covered / max(total, 1):.1f} %), wanted {LEAST} to {MOST} %; intervals {numpy.median(ratios):.2f} "
        f"times those from the spread (median), wanted {WIDEST} at most. Scans that `reconstruct` calls not trustworthy: {doubted}."
    )
