"""Calibrates the real rig of ../shared/scans/skull-calibration and compares with OpenCV on the same points.

Usage: /usr/bin/python3 tools/figures_calibration.py PROGRAM [SCANS] [OUT]

Copies the poses to OUT, adds scan.toml and a rig.toml that holds sizes only, runs `frangia calibrate rig`, solves the
same points with OpenCV's calibrateCamera and stereoCalibrate, and reconstructs the skull with the found and with the
given rig. Prints Markdown.
"""
import json
import pathlib
import shutil
import subprocess
import sys

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


def distance_to(reference, points):
    """Distances from a sample of the reference's vertices to points: the nearest after the best similarity."""
    from scipy.spatial import cKDTree
    rng = np.random.default_rng(1)
    moving = points[rng.permutation(len(points))[:40000]].copy()
    tree = cKDTree(reference)
    scale_all = 1.0
    for step in range(60):
        distance, index = tree.query(moving)
        near = distance <= np.quantile(distance, 0.8)
        a, b = moving[near], reference[index[near]]
        ca, cb = a.mean(0), b.mean(0)
        u, s, vt = np.linalg.svd((a - ca).T @ (b - cb))
        sign = np.diag([1, 1, np.sign(np.linalg.det(vt.T @ u.T))])
        rotation = vt.T @ sign @ u.T
        scale = np.trace(np.diag(s) @ sign) / np.sum((a - ca) ** 2)
        moving = scale * (moving - ca) @ rotation.T + cb
        scale_all *= scale
    distance, _ = tree.query(moving)
    return np.median(distance), np.quantile(distance, 0.9), scale_all


def reconstruct(program, skull, rig, folder):
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(skull, folder)
    for path in [folder, *folder.rglob("*")]:
        path.chmod(0o755 if path.is_dir() else 0o644)
    if rig:
        shutil.copy(rig, folder / "rig.toml")
    mesh = folder / "mesh.ply"
    subprocess.run([program, "--quiet", "reconstruct", folder, "-o", mesh], check=True)
    return vertices_of(mesh)


def main():
    program = pathlib.Path(sys.argv[1]).resolve()
    scans = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else "../shared/scans")
    out = pathlib.Path(sys.argv[3] if len(sys.argv) > 3 else "out/calibration")
    if not (scans / "skull-calibration").is_dir():
        sys.exit(f"{scans}/skull-calibration: there is no such folder; name the folder of the scans")
    out.mkdir(parents=True, exist_ok=True)
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
    reference = vertices_of(scans / "skull" / "reference.ply")
    print("\n| rig | median distance to reference.ply, mm | 90 %, mm | scale |\n|---|---|---|---|")
    for name, file in (("given", None), ("found", rig), ("found, flat board", out / "rig-flat.toml")):
        points = reconstruct(program, scans / "skull", file, out / "skull")
        median, high, scale = distance_to(reference, points)
        print(f"| {name} | {median:.3f} | {high:.3f} | {scale:.4f} |")


if __name__ == "__main__":
    main()
