"""Calibrates the real rig of ../shared/scans/skull-calibration and compares with OpenCV on the same points.

Usage: /usr/bin/python3 tools/figures_calibration.py PROGRAM [SCANS] [OUT]

Copies the poses to OUT, adds scan.toml and a rig.toml that holds sizes only, runs `frangia calibrate rig`, solves the
same points with OpenCV's calibrateCamera and stereoCalibrate, and reconstructs the skull with the found and with the
given rig. Then calibrates a simulated rig and compares it with the truth. Prints Markdown.
"""
import json
import pathlib
import shutil
import subprocess
import sys
import tomllib

import cv2
import numpy as np

CORNERS = (9, 13)
SQUARE_MM = 15.0  # not recorded; it sets the scale only

SCAN = f"""format = "frangia-scan"
version = 2
name = "skull calibration"

[board]
kind = "checkerboard"
corners = [{CORNERS[0]}, {CORNERS[1]}]
square_mm = {SQUARE_MM}
"""

RIG = """format = "frangia-rig"
version = 1

[camera]
size_px = [1688, 1352]

[projector]
model = "pinhole"
size_px = [1824, 1140]
"""

PATTERNS = [("columns-cue", "vertical", 1824), ("columns-fine", "vertical", 114),
            ("rows-cue", "horizontal", 1140), ("rows-fine", "horizontal", 71.25)]


def write_scan(source, folder):
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(source, folder)
    for path in [folder, *folder.rglob("*")]:
        path.chmod(0o755 if path.is_dir() else 0o644)
    text = SCAN
    for name, direction, period in PATTERNS:
        text += (f'\n[[pattern]]\nname = "{name}"\nkind = "fringe"\ndirection = "{direction}"\n'
                 f"period_px = {period}\nshifts_deg = [0, 240, 120]\n")
    for view in sorted((folder / "views").iterdir()):
        text += f'\n[[view]]\nfolder = "views/{view.name}"\n'
    (folder / "scan.toml").write_text(text)
    (folder / "rig.toml").write_text(RIG)


def solve_with_opencv(views):
    """Camera, projector and stereo errors of OpenCV, in its own definition, with k1 k2 p1 p2 k3 free."""
    board = np.zeros((CORNERS[0] * CORNERS[1], 3), np.float32)
    board[:, :2] = np.mgrid[:CORNERS[0], :CORNERS[1]].T.reshape(-1, 2) * SQUARE_MM
    objects, camera, projector = [], [], []
    for view in views:
        points = [p for p in view["points"] if None not in p]
        objects.append(board[[p[0] for p in points]])
        camera.append(np.float32([p[1:3] for p in points]))
        projector.append(np.float32([p[3:5] for p in points]))
    rms_c, k_c, d_c, _, _ = cv2.calibrateCamera(objects, camera, (1688, 1352), None, None)
    rms_p, k_p, d_p, _, _ = cv2.calibrateCamera(objects, projector, (1824, 1140), None, None)
    stereo = cv2.stereoCalibrate(objects, camera, projector, k_c, d_c, k_p, d_p, (1688, 1352),
                                 flags=cv2.CALIB_USE_INTRINSIC_GUESS,
                                 criteria=(cv2.TERM_CRITERIA_COUNT + cv2.TERM_CRITERIA_EPS, 300, 1e-9))
    rms, k_c, d_c, k_p, d_p, _, t, _, _ = stereo
    return rms_c, rms_p, rms, k_c, k_p, float(np.linalg.norm(t))


def vertices_of(path):
    """Vertices of a binary little-endian PLY whose first properties are float x, y, z."""
    data = path.read_bytes()
    end = data.index(b"end_header") + len(b"end_header")
    end = data.index(b"\n", end - 1) + 1
    header = data[:end].decode()
    sizes = {"float": 4, "double": 8, "uchar": 1, "int": 4, "uint": 4, "short": 2, "ushort": 2, "char": 1,
             "float32": 4, "float64": 8, "uint8": 1, "int32": 4}
    count, stride, in_vertex = 0, 0, False
    for line in header.splitlines():
        words = line.split()
        if words[:1] == ["element"]:
            in_vertex = words[1] == "vertex"
            count = int(words[2]) if in_vertex else count
        elif words[:1] == ["property"] and in_vertex:
            stride += sizes[words[1]]
    if "ascii" in header:
        rows = data[end:].decode().splitlines()[:count]
        return np.array([[float(x) for x in row.split()[:3]] for row in rows])
    raw = np.frombuffer(data, np.uint8, count * stride, end).reshape(count, stride)
    return raw[:, :12].copy().view("<f4").astype(float)


def distance_to(reference, points, scale):
    """Distances of the reference's vertices from points, in mm of the reference, after the best similarity.

    `scale` is mm of points per mm of the reference, as the baselines of the two rigs have it.
    """
    from scipy.spatial import cKDTree
    rng = np.random.default_rng(1)
    moving = scale * reference[rng.permutation(len(reference))[:30000]]
    tree = cKDTree(points)
    for _ in range(40):
        distance, index = tree.query(moving)
        near = distance <= np.quantile(distance, 0.8)
        a, b = moving[near], points[index[near]]
        ca, cb = a.mean(0), b.mean(0)
        u, s, vt = np.linalg.svd((a - ca).T @ (b - cb))
        sign = np.diag([1, 1, np.sign(np.linalg.det(vt.T @ u.T))])
        step = np.trace(np.diag(s) @ sign) / np.sum((a - ca) ** 2)
        moving = step * (moving - ca) @ (vt.T @ sign @ u.T).T + cb
        scale *= step
    distance, _ = tree.query(moving)
    return np.median(distance) / scale, np.quantile(distance, 0.9) / scale, scale


def run_reconstruct(program, scan, mesh):
    """Runs `frangia reconstruct`; a result that it calls not trustworthy (exit code 5) is measured, too."""
    answer = subprocess.run([program, "--quiet", "reconstruct", scan, "-o", mesh], capture_output=True, text=True)
    if answer.returncode not in (0, 5) or not mesh.exists():
        sys.exit(answer.stderr)
    return vertices_of(mesh)


def reconstruct(program, skull, rig, folder):
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(skull, folder)
    for path in [folder, *folder.rglob("*")]:
        path.chmod(0o755 if path.is_dir() else 0o644)
    if rig:
        shutil.copy(rig, folder / "rig.toml")
    return run_reconstruct(program, folder, folder / "mesh.ply")


def fit_sphere(points, center):
    """Center and diameter of the sphere through the points near a nominal ball of radius 20 mm."""
    near = points[np.abs(np.linalg.norm(points - center, axis=1) - 20) < 2]
    near = near[near[:, 2] > 48]  # above the post
    for _ in range(3):
        a = np.c_[2 * near, np.ones(len(near))]
        x = np.linalg.lstsq(a, np.sum(near**2, axis=1), rcond=None)[0]
        radius = np.sqrt(x[3] + x[:3] @ x[:3])
        error = np.abs(np.linalg.norm(near - x[:3], axis=1) - radius)
        near = near[error < max(3 * np.median(error), 0.01)]
    return x[:3], 2 * radius


def measure_simulated(program, out, poses):
    """Errors of a simulated rig, and a ball bar reconstructed with the true and with the found rig."""
    scan, found_file = out / "simulated", out / "rig-simulated.toml"
    shutil.rmtree(scan, ignore_errors=True)
    subprocess.run([program, "--quiet", "simulate", "--calibration", "checkerboard", "--views", str(poses), "--samples",
                    "4", "-o", scan], check=True)
    subprocess.run([program, "--quiet", "calibrate", "rig", scan, "-o", found_file], check=True)
    truth, found = (tomllib.loads(f.read_text()) for f in (scan / "truth-rig.toml", found_file))
    sigma = found["calibration"]["sigma"]
    print(f"\n| parameter, {poses} simulated poses | true | found | error / sigma |\n|---|---|---|---|")
    for device in ("camera", "projector"):
        for index, axis in enumerate("xy"):
            name = f"{device}.principal_{axis}_px"
            a, b = (rig[device]["principal_point_px"][index] for rig in (truth, found))
            print(f"| {name} | {a:.3f} | {b:.3f} | {(b - a) / sigma[name]:.2f} |")
        a, b = (rig[device]["focal_px"][0] for rig in (truth, found))
        print(f"| {device}.focal_px ({100 * (b / a - 1):+.4f} %) | {a:.3f} | {b:.3f} | "
              f"{(b - a) / sigma[device + '.focal_px']:.2f} |")
    a, b = (np.linalg.norm(rig["projector"]["position_mm"]) for rig in (truth, found))
    print(f"| baseline, mm | {a:.4f} | {b:.4f} | |")
    balls = out / "balls"
    shutil.rmtree(balls, ignore_errors=True)
    subprocess.run([program, "--quiet", "simulate", "ball-bar", "-o", balls], check=True)
    text = found_file.read_text()
    table = truth["turntable"]
    text += f"\n[turntable]\npoint_mm = {table['point_mm']}\naxis = {table['axis']}\n"
    true_text = (balls / "rig.toml").read_text()
    print("\n| ball bar reconstructed with | spacing, mm (70) | diameters, mm (40) |\n|---|---|---|")
    for name, rig in (("true rig", true_text), ("found rig", text)):
        (balls / "rig.toml").write_text(rig)
        points = run_reconstruct(program, balls, balls / "mesh.ply")
        (c1, d1), (c2, d2) = (fit_sphere(points, np.array([0, y, 60])) for y in (-35, 35))
        print(f"| {name} | {np.linalg.norm(c1 - c2):.4f} | {d1:.4f}, {d2:.4f} |")


def measure_real(program, scans, out):
    write_scan(scans / "skull-calibration", out / "poses")
    rig = out / "rig.toml"
    rows = []
    for name, options in (("frangia", []), ("frangia --flat-board", ["--flat-board"])):
        target = rig if not options else out / "rig-flat.toml"
        answer = subprocess.run([program, "--json", "calibrate", "rig", out / "poses", "-o", target, *options],
                                check=True, capture_output=True, text=True)
        result = json.loads(answer.stdout)
        rows.append((name, result["camera_rms_px"], result["projector_rms_px"], result["baseline_mm"]))
    rms_c, rms_p, rms, k_c, k_p, baseline = solve_with_opencv(result["views"])
    rows.append(("OpenCV calibrateCamera, each alone", rms_c, rms_p, None))
    rows.append(("OpenCV stereoCalibrate, both", rms, rms, baseline))
    print("| solved by | camera RMS, px | projector RMS, px | baseline, mm |\n|---|---|---|---|")
    for name, camera, projector, length in rows:
        print(f"| {name} | {camera:.3f} | {projector:.3f} | {'' if length is None else format(length, '.2f')} |")
    given = np.linalg.norm(tomllib.loads((scans / "skull" / "rig.toml").read_text())["projector"]["position_mm"])
    reference = vertices_of(scans / "skull" / "reference.ply")
    print("\n| rig | median distance to reference.ply, mm | 90 %, mm | scale |\n|---|---|---|---|")
    for name, file in (("given", None), ("found", rig), ("found, flat board", out / "rig-flat.toml")):
        points = reconstruct(program, scans / "skull", file, out / "skull")
        found = tomllib.loads((out / "skull" / "rig.toml").read_text())["projector"]["position_mm"]
        median, high, scale = distance_to(reference, points, np.linalg.norm(found) / given)
        print(f"| {name} | {median:.3f} | {high:.3f} | {scale:.4f} |")


def main():
    program = pathlib.Path(sys.argv[1]).resolve()
    scans = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else "../shared/scans")
    out = pathlib.Path(sys.argv[3] if len(sys.argv) > 3 else "out/calibration")
    if not (scans / "skull-calibration").is_dir():
        sys.exit(f"{scans}/skull-calibration: there is no such folder; name the folder of the scans")
    out.mkdir(parents=True, exist_ok=True)
    measure_real(program, scans, out)
    measure_simulated(program, out, 12)


if __name__ == "__main__":
    main()
