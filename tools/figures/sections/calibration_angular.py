"""Calibrates a simulated rig with an interferometer from a screen, a plate and a ball bar, and checks it.

The truth is the rig that rendered the captures. `frangia simulate` starts rig.toml 5 % and 3 degrees off.
"""
import math
import tomllib

import numpy

TITLE = "Calibration of a rig with an interferometer"

POSES, ANGLES, STATIONS = 8, 13, 5  # of screen, plate and ball bar
CASES = {"seed": 3, "wavefront": 1, "check": 1}


def rig_of(path):
    return tomllib.loads(path.read_text())


def degrees_between(a, b):
    a, b = numpy.array(a, float), numpy.array(b, float)
    return math.degrees(math.atan2(numpy.linalg.norm(numpy.cross(a, b)), a @ b))


def across(point, other, axis):
    """Distance of two points across an axis."""
    between = numpy.array(point) - other
    return numpy.linalg.norm(between - numpy.array(axis) * (between @ axis))


def theta0(rig):
    """Angle between the axes of camera and projector in the plane across the fringes, degrees."""
    rotation = rig["projector"]["rotation"]
    return math.degrees(math.atan2(rotation[0][2], rotation[2][2]))


def errors_of(found, truth):
    """Names and errors of the parameters."""
    table, true_table = found["turntable"], truth["turntable"]
    shift = across(
        found["projector"]["position_mm"], truth["projector"]["position_mm"], truth["projector"]["rotation"][1]
    )
    return {
        "focal length, px": found["camera"]["focal_px"][0] - truth["camera"]["focal_px"][0],
        "principal point, px": max(
            abs(a - b) for a, b in zip(found["camera"]["principal_point_px"], truth["camera"]["principal_point_px"])
        ),
        "theta0, degrees": theta0(found) - theta0(truth),
        "pitch, %": 100 * (found["projector"].get("pitch_scale", 1) / truth["projector"].get("pitch_scale", 1) - 1),
        "direction of the fringes, degrees": degrees_between(
            found["projector"]["rotation"][1], truth["projector"]["rotation"][1]
        ),
        "place of the projector across its fringes, mm": shift,
        "axis of the turntable, degrees": degrees_between(table["axis"], true_table["axis"]),
        "axis of the turntable, mm": across(table["point_mm"], true_table["point_mm"], true_table["axis"]),
        "laser sheet, degrees": degrees_between(found["line"]["normal"], truth["line"]["normal"]),
    }


def captures(study, seed):
    """Screen, plate and ball bar of the built-in angular rig."""

    def made(kind, views, *more):
        return study.simulated("--calibration", kind, "--rig", "angular", "--views", views, "--seed", seed, *more)

    return made("screen", POSES), made("plate", ANGLES, "--samples", 4), made("ball-bar", STATIONS, "--samples", 4)


def calibrated(study, scans):
    rig = study.work / "found.toml"
    study.run("calibrate", "rig", *scans, "-o", rig)
    return rig


def errors_of_seed(study, seed):
    """Errors at the start and of the calibrated rig."""
    scans = captures(study, seed)
    truth, found = rig_of(scans[1] / "truth-rig.toml"), rig_of(calibrated(study, scans))
    return {"start": errors_of(rig_of(scans[1] / "rig.toml"), truth), "found": errors_of(found, truth)}


WAVEFRONT_DEG = (0.2, -0.3, 0.1, 0, 0.1, -0.1)


def errors_under_wavefront(study):
    """The same captures by an interferometer whose fringes are not even, and angles of fringes at points of the volume."""
    truth, even = study.work / "truth.toml", captures(study, 1)[1] / "truth-rig.toml"
    lines = even.read_text().splitlines()
    at = next(i for i, line in enumerate(lines) if line.startswith("field_deg"))
    truth.write_text("\n".join([*lines[: at + 1], f"wavefront_deg = {list(WAVEFRONT_DEG)}", *lines[at + 1 :], ""]))
    rig = calibrated(
        study,
        [
            study.simulated("--calibration", kind, "--rig", truth, "--views", views)
            for kind, views in (("screen", POSES), ("plate", ANGLES), ("ball-bar", STATIONS))
        ],
    )
    points = numpy.random.default_rng(1).uniform((-50, -50, 440), (50, 50, 540), (10000, 3))
    off = fringe_angles(rig_of(rig), points) - fringe_angles(rig_of(truth), points)
    deviation = fringe_angles(rig_of(truth), points) - fringe_angles(rig_of(even), points)
    return {
        "deviation_deg": numpy.sqrt((deviation**2).mean()),
        "rms_deg": numpy.sqrt((off**2).mean()),
        "largest_deg": abs(off).max(),
    }


def fringe_angles(rig, points):
    """The angle that counts the fringes at points of the rig frame, degrees, by the formulas of docs/scan-format.md."""
    projector = rig["projector"]
    x, y, z = ((points - projector["position_mm"]) @ numpy.array(projector["rotation"]).T).T
    psi = numpy.degrees(numpy.arctan2(x, z))
    low, high = projector["field_deg"]
    half = (high - low) / 2
    u, v = (psi - (low + high) / 2) / half, numpy.degrees(y / numpy.hypot(x, z)) / half
    a, b, c, d, e, f = projector.get("wavefront_deg", [0] * 6)
    bend = a * u**2 + b * v**2 + c * u**3 + d * u**2 * v + e * u * v**2 + f * v**3
    return (psi + bend) / projector.get("pitch_scale", 1)


def knocked(rig, degrees, shift_mm):
    """The text of a rig.toml whose projector has turned about its fringes and moved."""
    parsed = rig_of(rig)
    turn = math.radians(degrees)
    about = numpy.array([[math.cos(turn), 0, math.sin(turn)], [0, 1, 0], [-math.sin(turn), 0, math.cos(turn)]])
    rotation = (about @ numpy.array(parsed["projector"]["rotation"])).tolist()
    position = [parsed["projector"]["position_mm"][0] + shift_mm, *parsed["projector"]["position_mm"][1:]]
    lines = []
    for line in rig.read_text().splitlines():
        if line.startswith("position_mm"):
            line = f"position_mm = {position}"
        if line.startswith("rotation"):
            line = f"rotation = {rotation}"
        lines.append(line)
    return "\n".join(lines) + "\n"


def checks(study):
    """Rows of `frangia calibrate check`, which ends with 1 where the rig is no longer what it was."""
    scans = captures(study, 3)
    rig, moved = calibrated(study, scans), study.work / "moved.toml"
    moved.write_text(knocked(rig, 0.1, 0.5))
    part, rows = study.digital("bracket", "angular"), []
    for name, scan in (("ball-bar", scans[2]), ("plate", scans[1]), ("part (bracket)", part)):
        for state, file in (("as found", rig), ("moved", moved)):
            for item in study.run("calibrate", "check", file, scan, allowed=(0, 1))["items"]:
                rows.append(
                    [
                        name,
                        state,
                        item["name"],
                        f"{item['deviation_mm']:+.4f}",
                        f"{item['limit_mm']:.4f}",
                        "passed" if item["passed"] else "failed",
                    ]
                )
    return rows


def measure(study, case, seed):
    if case == "seed":
        return errors_of_seed(study, seed)
    return errors_under_wavefront(study) if case == "wavefront" else checks(study)


def report(text, results):
    seeds = results["seed"]
    text.add(
        f"`frangia calibrate rig screen plate ball-bar -o rig.toml`: a screen in {POSES} poses, a plate on the turntable at {ANGLES} angles over 120 degrees, a ball bar at {STATIONS}; the built-in angular rig, 512 × 512 pixels, started 5 % and 3 degrees off. Largest error over {len(seeds)} seeds of noise and start.\n"
    )
    text.table("parameter", "error at the start", "largest error")
    for name in seeds[0]["found"]:
        start = "" if "px" in name else f"{max(abs(one['start'][name]) for one in seeds):.3g}"
        text.row(name, start, f"{max(abs(one['found'][name]) for one in seeds):.4f}")
    (one,) = results["wavefront"]
    text.add(
        f"\nA wavefront that deviates by {one['deviation_deg']:.4f} degrees RMS in the measuring volume: found with an error of {one['rms_deg']:.5f} degrees RMS, {one['largest_deg']:.5f} at most."
    )
    text.add(
        "\n`frangia calibrate check rig.toml SCAN`, with the found rig and with one whose projector was turned by 0.1 degrees and moved by 0.5 mm afterwards.\n"
    )
    text.table("scan", "rig", "figure", "deviation, mm", "limit, mm", "")
    for row in results["check"][0]:
        text.row(*row)
