"""Calibrates the real rig of ../shared/scans/skull-calibration and a simulated rig.

The real rig is compared with OpenCV's calibrateCamera and stereoCalibrate on the same points; the boards are measured
and the skull is reconstructed with the found and with the given rig. The simulated rig is compared with its truth.
"""
import functools
import shutil
import tomllib

import cv2
import numpy
from scipy.spatial import cKDTree

from board_captures import Capture, rendered
from surfaces import fit_ball, points_of, read_ply

TITLE = "Calibration of a rig"

CORNERS = (9, 13)
SQUARE_MM = 15.0  # not recorded; it sets the scale only
CAMERA_PX, PROJECTOR_PX = (1688, 1352), (1824, 1140)
POSES = 12  # of the simulated rig
CASES = {"real": 1, "simulated": 1, "ball bar": 1, "seeds": 40}

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

PATTERNS = [
    ("columns-cue", "vertical", 1824),
    ("columns-fine", "vertical", 114),
    ("rows-cue", "horizontal", 1140),
    ("rows-fine", "horizontal", 71.25),
]


def copied(source, folder):
    """A copy of a scan folder that can be changed."""
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(source, folder)
    for path in [folder, *folder.rglob("*")]:
        path.chmod(0o755 if path.is_dir() else 0o644)
    return folder


def copy_rig(rig, scan):
    """Gives a scan another rig, with the file of its covariance."""
    shutil.copy(rig, scan / "rig.toml")
    covariance = tomllib.loads(rig.read_text()).get("calibration", {}).get("covariance")
    if covariance:
        shutil.copy(rig.parent / covariance, scan / covariance)


def write_scan(source, folder):
    """The poses with a scan.toml, and with a rig.toml that holds sizes only."""
    copied(source, folder)
    text = SCAN
    for name, direction, period in PATTERNS:
        text += (
            f'\n[[pattern]]\nname = "{name}"\nkind = "fringe"\ndirection = "{direction}"\n'
            f"period_px = {period}\nshifts_deg = [0, 240, 120]\n"
        )
    for view in sorted((folder / "views").iterdir()):
        text += f'\n[[view]]\nfolder = "views/{view.name}"\n'
    (folder / "scan.toml").write_text(text)
    (folder / "rig.toml").write_text(RIG)
    return folder


def solve_with_opencv(views):
    """RMS errors of the camera alone, the projector alone and both together, with k1 k2 p1 p2 k3 free; the baseline."""
    board = numpy.zeros((CORNERS[0] * CORNERS[1], 3), numpy.float32)
    board[:, :2] = numpy.mgrid[: CORNERS[0], : CORNERS[1]].T.reshape(-1, 2) * SQUARE_MM
    objects, camera, projector = [], [], []
    for view in views:
        points = [p for p in view["points"] if None not in p]
        objects.append(board[[p[0] for p in points]])
        camera.append(numpy.float32([p[1:3] for p in points]))
        projector.append(numpy.float32([p[3:5] for p in points]))
    rms_c, k_c, d_c, _, _ = cv2.calibrateCamera(objects, camera, CAMERA_PX, None, None)
    rms_p, k_p, d_p, _, _ = cv2.calibrateCamera(objects, projector, PROJECTOR_PX, None, None)
    rms, _, _, _, _, _, t, _, _ = cv2.stereoCalibrate(
        objects,
        camera,
        projector,
        k_c,
        d_c,
        k_p,
        d_p,
        CAMERA_PX,
        flags=cv2.CALIB_USE_INTRINSIC_GUESS,
        criteria=(cv2.TERM_CRITERIA_COUNT + cv2.TERM_CRITERIA_EPS, 300, 1e-9),
    )
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


def rig_of(path):
    """Camera matrix and distortion, those of the projector, and the pose p = R X + t, as OpenCV has them."""
    rig = tomllib.loads(path.read_text())
    parts = []
    for device in ("camera", "projector"):
        (fx, fy), (cx, cy) = rig[device]["focal_px"], rig[device]["principal_point_px"]
        parts += [numpy.array([[fx, 0, cx], [0, fy, cy], [0, 0, 1]]), numpy.array(rig[device]["distortion"], float)]
    rotation = numpy.array(rig["projector"]["rotation"])
    return *parts, rotation, -rotation @ numpy.array(rig["projector"]["position_mm"])


def project(points, matrix, distortion, rotation=numpy.eye(3), shift=numpy.zeros(3)):
    return cv2.projectPoints(points, cv2.Rodrigues(rotation)[0], shift, matrix, distortion)[0][:, 0]


def triangulated(rig, pixels, columns, depth):
    """Where the rays of camera pixels meet the sheets of light of projector columns; `depth` is a start."""
    rays = numpy.c_[
        cv2.undistortPoints(pixels.reshape(-1, 1, 2).astype(float), rig[0], rig[1])[:, 0], numpy.ones(len(pixels))
    ]
    z, step = numpy.broadcast_to(depth, len(rays)).astype(float), 1e-3
    for _ in range(15):
        here, there = (project(rays * (z + d)[:, None], *rig[2:])[:, 0] - columns for d in (0.0, step))
        z = z - here * step / (there - here)
    return rays * z[:, None]


def board_lengths(rig, views, depth):
    """Lengths of the two sides of the triangulated board of each view over their mean; median distance from a plane, over the mean length of a square."""
    lengths, heights = [], []
    for view in views:
        points = numpy.array([p for p in view["points"] if None not in p])
        index = points[:, 0].astype(int)
        place = numpy.c_[index % CORNERS[0], index // CORNERS[0], numpy.ones(len(index))]
        measured = triangulated(rig, points[:, 1:3], points[:, 3], depth)
        weight = numpy.ones(len(place))
        for _ in range(5):
            fit = numpy.linalg.lstsq(place * weight[:, None], measured * weight[:, None], rcond=None)[0]
            error = numpy.linalg.norm(measured - place @ fit, axis=1)
            weight = numpy.maximum(error, numpy.median(error)) ** -0.5
        normal = numpy.cross(fit[0], fit[1])
        heights.append(numpy.median(abs((measured - place @ fit) @ normal)) / numpy.linalg.norm(normal))
        lengths += [numpy.linalg.norm(fit[0]), numpy.linalg.norm(fit[1])]
    mean = numpy.mean(lengths)
    return numpy.array(lengths) / mean, numpy.mean(heights) / mean


def vertices_of(study, scan):
    """The vertices of a scan's mesh; a result that the program calls not trustworthy (exit code 5) is measured, too."""
    mesh = scan / "mesh.ply"
    study.process("--quiet", "reconstruct", scan, "-o", mesh, allowed=(0, 5))
    return points_of(read_ply(mesh))


def measure_real(study):
    """Rows of the three tables about the real rig."""
    poses = write_scan(study.shared("skull-calibration"), study.work / "skull-poses")
    rigs = {"frangia": study.work / "skull-rig.toml", "frangia --flat-board": study.work / "skull-rig-flat.toml"}
    solved_by, boards, skulls = [], [], []
    for name, rig in rigs.items():
        result = study.run("calibrate", "rig", poses, "-o", rig, *name.split()[1:])
        solved_by.append(
            [
                name,
                f"{result['camera_rms_px']:.3f}",
                f"{result['projector_rms_px']:.3f}",
                f"{result['baseline_mm']:.2f}",
            ]
        )
    rms_c, rms_p, rms, baseline = solve_with_opencv(result["views"])
    solved_by += [
        ["OpenCV calibrateCamera, each alone", f"{rms_c:.3f}", f"{rms_p:.3f}", ""],
        ["OpenCV stereoCalibrate, both", f"{rms:.3f}", f"{rms:.3f}", f"{baseline:.2f}"],
    ]
    skull = study.shared("skull")
    rigs = {"given": skull / "rig.toml", **rigs}
    solved = {name: rig_of(rig) for name, rig in rigs.items()}
    baseline = {name: numpy.linalg.norm(rig[-1]) for name, rig in solved.items()}
    for name, rig in solved.items():
        lengths, height = board_lengths(rig, result["views"], 2.4 * baseline[name])
        boards.append([name, f"{lengths.min():.4f} to {lengths.max():.4f}", f"{height:.4f}"])
    reference = points_of(read_ply(skull / "reference.ply"))
    given = solved["given"]
    pixels, columns = project(reference, *given[:2]), project(reference, *given[2:])[:, 0]
    for name, rig in rigs.items():
        scan = copied(skull, study.work / "skull-scan")
        copy_rig(rig, scan)
        scale = baseline[name] / baseline["given"]
        vertices = vertices_of(study, scan)
        median, high, fitted = distance_to(reference, vertices, scale)
        again = triangulated(solved[name], pixels, columns, scale * reference[:, 2])
        own, _, _ = distance_to(again, vertices, 1.0)
        skulls.append([name, f"{median:.3f}", f"{high:.3f}", f"{fitted:.4f}", f"{own / scale:.3f}"])
    return [solved_by, boards, skulls]


def report_real(text, tables):
    heads = [
        (
            "`frangia calibrate rig poses -o rig.toml` on the poses of a real rig, and OpenCV on the same points. OpenCV's error of both is over all points of camera and projector.\n",
            ("solved by", "camera RMS, px", "projector RMS, px", "baseline, mm"),
        ),
        (
            "\nThe six boards, triangulated by each rig from the camera's corners and the phases of the columns alone. A rig that is right measures the sides of the board alike in all poses.\n",
            ("rig", "sides of the board, over their mean", "median distance from a plane, of a square"),
        ),
        (
            "\nThe skull, reconstructed with each rig, after the best similarity; the square of the board is not recorded, so the scale is open. `reference.ply` was itself triangulated with the given rig and carries its errors. The last column compares with the same measurement of the reference, triangulated with the rig of the row.\n",
            (
                "rig",
                "median distance from reference.ply, mm",
                "90 %, mm",
                "scale",
                "median distance from the reference triangulated by the rig, mm",
            ),
        ),
    ]
    for (intro, columns), rows in zip(heads, tables):
        text.add(intro)
        text.table(*columns)
        for row in rows:
            text.row(*row)


def values_of(rig):
    """The parameters of a rig.toml by their names in the covariance."""
    values = {}
    for device in ("camera", "projector"):
        (fx, fy), (cx, cy) = rig[device]["focal_px"], rig[device]["principal_point_px"]
        names = ("focal_px", "focal_ratio", "principal_x_px", "principal_y_px", "k1", "k2", "p1", "p2", "k3")
        values |= {
            f"{device}.{name}": value for name, value in zip(names, (fx, fy / fx, cx, cy, *rig[device]["distortion"]))
        }
    rotation = numpy.array(rig["projector"]["rotation"])
    shift = -rotation @ numpy.array(rig["projector"]["position_mm"])
    for axis, turn, move in zip("xyz", cv2.Rodrigues(rotation)[0].ravel(), shift):
        values |= {f"projector.rotation_{axis}_rad": turn, f"projector.{axis}_mm": move}
    return values


@functools.cache
def capture_of(study):
    return Capture(rendered(study, "checkerboard", POSES))


def error_of_seed(study, seed):
    """Errors of the estimated parameters by their names, and normalized by their full covariance: error' C^-1 error and their number."""
    capture = capture_of(study)
    scan, file = capture.write(study.work / "seed-scan", seed), study.work / "seed-rig.toml"
    study.run("calibrate", "rig", scan, "-o", file)
    found = tomllib.loads(file.read_text())
    lines = (file.parent / found["calibration"]["covariance"]).read_text().splitlines()
    names = [name.strip().strip('"') for name in lines[0].split(",")][1:]
    covariance = numpy.array([[float(x) for x in line.split(",")[1:]] for line in lines[1:]])
    a, b = values_of(capture.truth), values_of(found)
    # A held term is true by construction here, so it says nothing about the covariance.
    kept = [i for i, name in enumerate(names) if a[name] != b[name]]
    names, covariance = [names[i] for i in kept], covariance[numpy.ix_(kept, kept)]
    error = numpy.array([b[name] - a[name] for name in names])
    scale = numpy.sqrt(numpy.diag(covariance))
    normalized = error / scale
    square = normalized @ numpy.linalg.solve(covariance / numpy.outer(scale, scale), normalized)
    return {
        "square": square,
        "count": len(names),
        "errors": dict(zip(names, error)),
        "normalized": dict(zip(names, normalized)),
        "baseline_mm": numpy.linalg.norm(found["projector"]["position_mm"])
        - numpy.linalg.norm(capture.truth["projector"]["position_mm"]),
        "focal": [found[d]["focal_px"][0] / capture.truth[d]["focal_px"][0] - 1 for d in ("camera", "projector")],
    }


def report_seeds(text, errors):
    """Errors of many calibrations against their stated covariance."""
    pooled = numpy.sqrt(sum(e["square"] for e in errors) / sum(e["count"] for e in errors))
    text.add(
        f"\n{POSES} poses of 640 × 512 pixels, rendered once and calibrated with {len(errors)} seeds of the noise.\n"
    )
    text.table("figure", "value")
    text.row("errors of the estimated parameters, normalized by their full covariance, RMS", f"{pooled:.2f}")
    text.row(
        "largest relative error of a focal length", f"{100 * max(abs(f) for e in errors for f in e['focal']):.4f} %"
    )
    points = [(abs(e["errors"][n]), abs(e["normalized"][n])) for e in errors for n in e["errors"] if "principal" in n]
    text.row(
        "largest error of a principal point, px; over its standard deviation",
        f"{max(p[0] for p in points):.3f}; {max(p[1] for p in points):.2f}",
    )
    text.row("largest error of the baseline, mm", f"{max(abs(e['baseline_mm']) for e in errors):.4f}")


def calibrated(study):
    """A simulated capture, and the rig that its calibration finds."""
    scan, file = (
        study.simulated("--calibration", "checkerboard", "--views", POSES, "--samples", 4),
        study.work / "rig-simulated.toml",
    )
    study.run("calibrate", "rig", scan, "-o", file)
    return scan, file


def measure_simulated(study):
    """Rows of true and found parameters."""
    scan, file = calibrated(study)
    truth, found = (tomllib.loads(f.read_text()) for f in (scan / "truth-rig.toml", file))
    sigma, rows = found["calibration"]["sigma"], []
    for device in ("camera", "projector"):
        for index, axis in enumerate("xy"):
            name = f"{device}.principal_{axis}_px"
            a, b = (rig[device]["principal_point_px"][index] for rig in (truth, found))
            rows.append([name, f"{a:.3f}", f"{b:.3f}", f"{(b - a) / sigma[name]:.2f}"])
        name = f"{device}.focal_px"
        a, b = (rig[device]["focal_px"][0] for rig in (truth, found))
        rows.append([name, f"{a:.3f}", f"{b:.3f}", f"{(b - a) / sigma[name]:.2f}"])
    a, b = (numpy.linalg.norm(rig["projector"]["position_mm"]) for rig in (truth, found))
    return rows + [["baseline, mm", f"{a:.4f}", f"{b:.4f}", ""]]


def measure_ball_bar(study):
    """Rows of a ball bar that the true rig rendered, reconstructed with the true and with the found rig."""
    scan, file = calibrated(study)
    bar = copied(study.digital("ball-bar"), study.work / "ball-bar")
    table, rows = tomllib.loads((scan / "truth-rig.toml").read_text())["turntable"], []
    rigs = {
        "true rig": (bar / "rig.toml").read_text(),
        "found rig": file.read_text() + f"\n[turntable]\npoint_mm = {table['point_mm']}\naxis = {table['axis']}\n",
    }
    copy_rig(file, bar)
    for name, text in rigs.items():
        (bar / "rig.toml").write_text(text)
        points = vertices_of(study, bar)
        centres, diameters = [], []
        for side in (-35.0, 35.0):
            # A calibration may shift the whole frame, so the second fit selects about the first.
            centre, radius, _ = fit_ball(points, [0.0, side, 60.0], within=2.0)
            centre, radius, _ = fit_ball(points, centre, radius, within=0.2)
            centres.append(centre)
            diameters.append(f"{2 * radius:.4f}")
        rows.append([name, f"{numpy.linalg.norm(centres[0] - centres[1]):.4f}", ", ".join(diameters)])
    return rows


def measure(study, case, seed):
    if case == "seeds":
        return error_of_seed(study, seed)
    return {"real": measure_real, "simulated": measure_simulated, "ball bar": measure_ball_bar}[case](study)


def report(text, results):
    report_real(text, results["real"][0])
    text.add(
        f"\n`frangia simulate --calibration checkerboard --views {POSES}`, calibrated, against the rig that rendered the poses.\n"
    )
    text.table("parameter", "true", "found", "error over sigma")
    for row in results["simulated"][0]:
        text.row(*row)
    text.add("\nA ball bar, rendered by the true rig and reconstructed with each.\n")
    text.table("reconstructed with", "spacing, mm (70)", "diameters, mm (40)")
    for row in results["ball bar"][0]:
        text.row(*row)
    report_seeds(text, results["seeds"])
