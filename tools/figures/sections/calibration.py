"""Calibrates the real rig of ../shared/scans/skull-calibration and a simulated rig.

The real rig is compared with OpenCV's calibrateCamera and stereoCalibrate on the same points, and the skull is
reconstructed with the found and with the given rig. The simulated rig is compared with its truth.
"""
import shutil
import subprocess
import sys
import tomllib

import cv2
import numpy
from scipy.spatial import cKDTree

from surfaces import fit_ball, points_of, read_ply

TITLE = "Calibration of a rig"

CORNERS = (9, 13)
SQUARE_MM = 15.0  # not recorded; it sets the scale only
CAMERA_PX, PROJECTOR_PX = (1688, 1352), (1824, 1140)
POSES = 12  # of the simulated rig

SCAN = f"""format = "frangia-scan"
version = 2
name = "skull calibration"

[board]
kind = "checkerboard"
corners = [{CORNERS[0]}, {CORNERS[1]}]
square_mm = {SQUARE_MM}
"""

RIG = f"""format = "frangia-rig"
version = 1

[camera]
size_px = [{CAMERA_PX[0]}, {CAMERA_PX[1]}]

[projector]
model = "pinhole"
size_px = [{PROJECTOR_PX[0]}, {PROJECTOR_PX[1]}]
"""

PATTERNS = [("columns-cue", "vertical", 1824), ("columns-fine", "vertical", 114),
            ("rows-cue", "horizontal", 1140), ("rows-fine", "horizontal", 71.25)]


def copied(source, folder):
    """A copy of a scan folder that can be changed."""
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(source, folder)
    for path in [folder, *folder.rglob("*")]:
        path.chmod(0o755 if path.is_dir() else 0o644)
    return folder


def write_scan(source, folder):
    """The poses with a scan.toml, and with a rig.toml that holds sizes only."""
    copied(source, folder)
    text = SCAN
    for name, direction, period in PATTERNS:
        text += (f'\n[[pattern]]\nname = "{name}"\nkind = "fringe"\ndirection = "{direction}"\n'
                 f"period_px = {period}\nshifts_deg = [0, 240, 120]\n")
    for view in sorted((folder / "views").iterdir()):
        text += f'\n[[view]]\nfolder = "views/{view.name}"\n'
    (folder / "scan.toml").write_text(text)
    (folder / "rig.toml").write_text(RIG)
    return folder


def solve_with_opencv(views):
    """RMS errors of the camera alone, the projector alone and both together, with k1 k2 p1 p2 k3 free; the baseline."""
    board = numpy.zeros((CORNERS[0] * CORNERS[1], 3), numpy.float32)
    board[:, :2] = numpy.mgrid[:CORNERS[0], :CORNERS[1]].T.reshape(-1, 2) * SQUARE_MM
    objects, camera, projector = [], [], []
    for view in views:
        points = [p for p in view["points"] if None not in p]
        objects.append(board[[p[0] for p in points]])
        camera.append(numpy.float32([p[1:3] for p in points]))
        projector.append(numpy.float32([p[3:5] for p in points]))
    rms_c, k_c, d_c, _, _ = cv2.calibrateCamera(objects, camera, CAMERA_PX, None, None)
    rms_p, k_p, d_p, _, _ = cv2.calibrateCamera(objects, projector, PROJECTOR_PX, None, None)
    rms, _, _, _, _, _, t, _, _ = cv2.stereoCalibrate(
        objects, camera, projector, k_c, d_c, k_p, d_p, CAMERA_PX, flags=cv2.CALIB_USE_INTRINSIC_GUESS,
        criteria=(cv2.TERM_CRITERIA_COUNT + cv2.TERM_CRITERIA_EPS, 300, 1e-9))
    return rms_c, rms_p, rms, float(numpy.linalg.norm(t))


def distance_to(reference, points, scale):
    """Median and 90 % of the distances of a reference from points, mm of the reference, after the best similarity.

    `scale` is the initial ratio of a length in points to that in the reference; the fitted one is returned, too.
    """
    moving = scale * reference[numpy.random.default_rng(1).permutation(len(reference))[:30000]]
    tree = cKDTree(points)
    for _ in range(40):
        distance, index = tree.query(moving)
        near = distance <= numpy.quantile(distance, 0.8)
        a, b = moving[near], points[index[near]]
        ca, cb = a.mean(0), b.mean(0)
        u, s, vt = numpy.linalg.svd((a - ca).T @ (b - cb))
        sign = numpy.diag([1, 1, numpy.sign(numpy.linalg.det(vt.T @ u.T))])
        step = numpy.trace(numpy.diag(s) @ sign) / numpy.sum((a - ca) ** 2)
        moving = step * (moving - ca) @ (vt.T @ sign @ u.T).T + cb
        scale *= step
    distance, _ = tree.query(moving)
    return numpy.median(distance) / scale, numpy.quantile(distance, 0.9) / scale, scale


def reconstructed(study, scan):
    """The vertices of a scan's mesh; a result that the program calls not trustworthy (exit code 5) is measured, too."""
    mesh = scan / "mesh.ply"
    answer = subprocess.run([study.program, "--quiet", "reconstruct", scan, "-o", mesh], capture_output=True, text=True)
    if answer.returncode not in (0, 5) or not mesh.exists():
        sys.exit(f"figures: {scan} could not be reconstructed: {answer.stderr}")
    return points_of(read_ply(mesh))


def measure_real(study):
    poses = write_scan(study.shared("skull-calibration"), study.work / "skull-poses")
    rigs = {"frangia": study.work / "skull-rig.toml", "frangia --flat-board": study.work / "skull-rig-flat.toml"}
    study.add("`frangia calibrate rig poses -o rig.toml` on the poses of a real rig, and OpenCV on the same points. OpenCV's error of both is over all points of camera and projector.\n")
    study.table("solved by", "camera RMS, px", "projector RMS, px", "baseline, mm")
    for name, rig in rigs.items():
        result = study.run("calibrate", "rig", poses, "-o", rig, *name.split()[1:])
        study.row(name, f"{result['camera_rms_px']:.3f}", f"{result['projector_rms_px']:.3f}", f"{result['baseline_mm']:.2f}")
    rms_c, rms_p, rms, baseline = solve_with_opencv(result["views"])
    study.row("OpenCV calibrateCamera, each alone", f"{rms_c:.3f}", f"{rms_p:.3f}", "")
    study.row("OpenCV stereoCalibrate, both", f"{rms:.3f}", f"{rms:.3f}", f"{baseline:.2f}")
    skull = study.shared("skull")
    given = tomllib.loads((skull / "rig.toml").read_text())["projector"]["position_mm"]
    reference = points_of(read_ply(skull / "reference.ply"))
    study.add("\nThe skull, reconstructed with each rig, after the best similarity to `reference.ply`; the square of the board is not recorded, so the scale is open.\n")
    study.table("rig", "median distance, mm", "90 %, mm", "scale")
    for name, rig in {"given": skull / "rig.toml", **rigs}.items():
        scan = copied(skull, study.work / "skull-scan")
        shutil.copy(rig, scan / "rig.toml")
        found = tomllib.loads(rig.read_text())["projector"]["position_mm"]
        median, high, scale = distance_to(reference, reconstructed(study, scan), numpy.linalg.norm(found) / numpy.linalg.norm(given))
        study.row(name, f"{median:.3f}", f"{high:.3f}", f"{scale:.4f}")


def measure_simulated(study):
    """Errors of a simulated rig, and a ball bar reconstructed with the true and with the found rig."""
    scan, file = study.made("poses", "simulate", "--calibration", "checkerboard", "--views", POSES, "--samples", 4), study.work / "rig-simulated.toml"
    study.run("calibrate", "rig", scan, "-o", file)
    truth, found = (tomllib.loads(f.read_text()) for f in (scan / "truth-rig.toml", file))
    sigma = found["calibration"]["sigma"]
    study.add(f"\n`frangia simulate --calibration checkerboard --views {POSES}`, calibrated, against the rig that rendered the poses.\n")
    study.table("parameter", "true", "found", "error over sigma")
    for device in ("camera", "projector"):
        for index, axis in enumerate("xy"):
            name = f"{device}.principal_{axis}_px"
            a, b = (rig[device]["principal_point_px"][index] for rig in (truth, found))
            study.row(name, f"{a:.3f}", f"{b:.3f}", f"{(b - a) / sigma[name]:.2f}")
        name = f"{device}.focal_px"
        a, b = (rig[device]["focal_px"][0] for rig in (truth, found))
        study.row(name, f"{a:.3f}", f"{b:.3f}", f"{(b - a) / sigma[name]:.2f}")
    a, b = (numpy.linalg.norm(rig["projector"]["position_mm"]) for rig in (truth, found))
    study.row("baseline, mm", f"{a:.4f}", f"{b:.4f}", "")
    bar = copied(study.simulated("ball-bar"), study.work / "ball-bar-calibrated")
    table = truth["turntable"]
    rigs = {"true rig": (bar / "rig.toml").read_text(),
            "found rig": file.read_text() + f"\n[turntable]\npoint_mm = {table['point_mm']}\naxis = {table['axis']}\n"}
    study.add("\nA ball bar, rendered by the true rig and reconstructed with each.\n")
    study.table("reconstructed with", "spacing, mm (70)", "diameters, mm (40)")
    for name, text in rigs.items():
        (bar / "rig.toml").write_text(text)
        points = reconstructed(study, bar)
        centres, diameters = [], []
        for side in (-35.0, 35.0):
            # A calibration may shift the whole frame, so the second fit selects about the first.
            centre, radius, _ = fit_ball(points, [0.0, side, 60.0], within=2.0)
            centre, radius, _ = fit_ball(points, centre, radius, within=0.2)
            centres.append(centre)
            diameters.append(f"{2 * radius:.4f}")
        study.row(name, f"{numpy.linalg.norm(centres[0] - centres[1]):.4f}", ", ".join(diameters))


def measure(study):
    measure_real(study)
    measure_simulated(study)
