"""Two cameras with a projector, and with the projector as a label only, against one camera."""
import json
import math
import os
import re
import shutil

import numpy

from study import NotAsWanted

TITLE = "Two cameras"

LEAST, MOST = 0.7, 1.5  # of error over sigma
NOT_TRUSTWORTHY = 5  # exit code
SUBJECT, VIEWS = "bracket", 6
RIG_CAMERAS = re.compile(r"\n\[\[more_cameras\]\].*?(?=\n\[projector\])", re.DOTALL)
ROTATION = re.compile(r"(\[\[more_cameras\]\].*?rotation = )(\[\[.*?\]\])", re.DOTALL)


def changed(study, scan, change):
    """A scan with another rig.toml and the same frames."""
    folder = study.fresh("changed")
    folder.mkdir()
    shutil.copytree(scan / "views", folder / "views", copy_function=os.link)
    for entry in ("truth.ply", "scan.toml"):
        os.link(scan / entry, folder / entry)
    (folder / "rig.toml").write_text(change((scan / "rig.toml").read_text()))
    return folder


def turned(text, degrees):
    """The second camera turned about the vertical axis of its image."""
    found = ROTATION.search(text)
    rotation = numpy.array(eval(found.group(2)))
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    rotation = numpy.array([[c, 0, s], [0, 1, 0], [-s, 0, c]]) @ rotation
    return text.replace(found.group(2), str(rotation.tolist()))


METHODS = {
    "one camera and the projector": lambda text: RIG_CAMERAS.sub("", text),
    "two cameras and the projector": lambda text: text,
    "two cameras, projector as a label": lambda text: text.replace('model = "pinhole"', 'model = "label"'),
}
FAULTS = {
    "none": (),
    "gamma 2.2": ("--display-gamma", 2.2),
    "gamma 2.2, three steps": ("--display-gamma", 2.2, "--shifts", 3),
}
TURNS = (0.01, 0.2)  # degrees
CASES = {
    **{f"{fault}: {method}": 1 for fault in FAULTS for method in METHODS},
    **{f"turned: {degrees}": 1 for degrees in TURNS},
}


def measure(study, case, seed):
    """The answer, and the comparison over the surface that the true rig can measure: a label lights nothing.

    No comparison where the program states that the result is not trustworthy.
    """
    fault, what = case.split(": ")
    scan = study.digital(SUBJECT, "binocular", "--views", VIEWS, *FAULTS.get(fault, ()))
    change = METHODS[what] if fault in FAULTS else lambda text: turned(text, float(what))
    mesh, folder = study.work / "mesh.ply", changed(study, scan, change)
    process = study.process(
        "--json", "reconstruct", folder, "--undo-response", "none", "-o", mesh, allowed=(0, NOT_TRUSTWORTHY)
    )
    error = (
        study.run("inspect", mesh, "--reference", folder / "truth.ply", "--scan", scan)
        if process.returncode == 0
        else None
    )
    return {"answer": json.loads(process.stdout), "error": error}


def report(text, results):
    failures = []
    text.add(
        f"`frangia simulate {SUBJECT} --rig binocular --samples 4 --views {VIEWS}`: the digital rig with a second camera on the other side of the projector, three fringe periods of four steps; then `frangia reconstruct` with the rig.toml of each row. Completeness is that of the surface that the cameras of the row can measure; gamma is not corrected (`--undo-response none`). Wanted: two cameras below one; under gamma a label much better than one camera; error over sigma {LEAST} to {MOST}, and at most {MOST} under gamma, whose systematic part is an upper bound.\n"
    )
    text.table(
        "fault",
        "method",
        "points",
        "triangles",
        "RMS mm",
        "95 % mm",
        "99 % mm",
        "mean mm",
        "completeness",
        "median sigma mm",
        "error over sigma",
        "cameras apart, mm",
        "over their noise",
    )
    for fault in FAULTS:
        p95 = {}
        for method in METHODS:
            (one,) = results[f"{fault}: {method}"]
            answer, error = one["answer"], one["error"]
            if error is None:
                p95[method] = math.inf
                text.row(fault, method, "not trustworthy", *["-"] * 10)
                continue
            cameras = answer.get("cameras", {})
            apart, over = cameras.get("disagreement_mm"), cameras.get("over_noise")
            p95[method] = error["p95_mm"]
            text.row(
                fault,
                method,
                answer["points"],
                answer["triangles"],
                f"{error['rms_mm']:.4f}",
                f"{error['p95_mm']:.4f}",
                f"{error['p99_mm']:.4f}",
                f"{error['mean_mm']:+.4f}",
                f"{100 * error['completeness']:.1f} %",
                f"{answer['median_sigma']['combined_mm']:.4f}",
                f"{error['sigma_ratio']:.2f}",
                "-" if apart is None else f"{apart:.4f}",
                "-" if over is None else f"{over:.2f}",
            )
            if not (LEAST if fault == "none" else 0.0) < error["sigma_ratio"] < MOST:
                failures.append(f"error over sigma of {method}, {fault}")
        one, two, label = p95.values()
        if two > one:
            failures.append(f"two cameras, {fault}")
        if fault != "none" and label > 0.5 * one:
            failures.append(f"the label, {fault}")

    text.add("\nThe second camera turned about the vertical axis of its image, after the calibration:\n")
    text.table("turned by", "RMS mm", "error over sigma", "cameras apart, mm", "over their noise")
    for degrees in TURNS:
        (one,) = results[f"turned: {degrees}"]
        cameras, error = one["answer"]["cameras"], one["error"]
        result = (
            ("not trustworthy", "-") if error is None else (f"{error['rms_mm']:.4f}", f"{error['sigma_ratio']:.2f}")
        )
        text.row(f"{degrees}°", *result, f"{cameras['disagreement_mm']:.4f}", f"{cameras['over_noise']:.1f}")
        if cameras["over_noise"] < 2:
            failures.append(f"the camera turned by {degrees}°")
    if failures:
        raise NotAsWanted(", ".join(failures))
