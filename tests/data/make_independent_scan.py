#!/usr/bin/python3
"""Writes a small scan whose frames are computed without Frangia's code: make_independent_scan.py FOLDER.

The scene is analytic: a plane behind a sphere, both fixed to the turntable. Camera, lens distortion, projector,
turntable and fringes are written here from docs/scan-format.md and OpenCV's formulas alone, so that a wrong
convention in Frangia's camera model does not cancel between its simulator and its decoder.
Needs NumPy only.
"""
import pathlib
import struct
import sys
import zlib

import numpy as np

WIDTH, HEIGHT = 320, 240
FX, FY, CX, CY = 610.0, 606.0, 163.3, 117.2
K1, K2, P1, P2, K3 = -0.12, 0.06, 6e-4, -4e-4, 0.02
PROJECTOR_SIZE = (800, 600)
PROJECTOR_F, PROJECTOR_CX, PROJECTOR_CY = 1150.0, 402.5, 295.0
PROJECTOR_POSITION = np.array([150.0, -12.0, 20.0])
AXIS_POINT = np.array([4.0, 30.0, 400.0])
AXIS = np.array([0.03, -0.92, -0.39])
ANGLES_DEG = [0.0, 25.0, -30.0]
PERIODS_PX = [800.0, 100.0, 12.5]
SHIFTS = 4
# Object frame: a sphere and a plane through `PLANE_POINT` that faces the camera at angle 0.
SPHERE_CENTER, SPHERE_RADIUS = np.array([8.0, -3.0, 12.0]), 22.0
PLANE_POINT, PLANE_NORMAL = np.array([-25.0, 0.0, 0.0]), np.array([0.95, 0.05, 0.3])


def unit(vector):
    return vector / np.linalg.norm(vector)


def rotation_about(axis, angle_rad):
    """Rodrigues' formula."""
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle_rad) * cross + (1 - np.cos(angle_rad)) * cross @ cross


def projector_rotation():
    """Rows are the projector's x, y and z axes in the rig frame; z points at the turntable."""
    forward = unit(AXIS_POINT + np.array([0.0, -10.0, 0.0]) - PROJECTOR_POSITION)
    right = unit(np.cross(np.array([0.05, 1.0, 0.0]), forward))
    return np.array([right, np.cross(forward, right), forward])


def camera_rays():
    """Normalized undistorted coordinates of the pixel centres, by Newton's method on OpenCV's distortion."""
    u, v = np.meshgrid(np.arange(WIDTH, dtype=float), np.arange(HEIGHT, dtype=float))
    xd, yd = (u - CX) / FX, (v - CY) / FY

    def distort(x, y):
        r2 = x * x + y * y
        radial = 1 + K1 * r2 + K2 * r2**2 + K3 * r2**3
        return (
            x * radial + 2 * P1 * x * y + P2 * (r2 + 2 * x * x),
            y * radial + P1 * (r2 + 2 * y * y) + 2 * P2 * x * y,
        )

    x, y = xd.copy(), yd.copy()
    step = 1e-6
    for _ in range(20):
        fx, fy = distort(x, y)
        ax, ay = distort(x + step, y)
        bx, by = distort(x, y + step)
        j11, j21, j12, j22 = (ax - fx) / step, (ay - fy) / step, (bx - fx) / step, (by - fy) / step
        ex, ey = xd - fx, yd - fy
        det = j11 * j22 - j12 * j21
        x, y = x + (j22 * ex - j12 * ey) / det, y + (j11 * ey - j21 * ex) / det
    return np.stack([x, y, np.ones_like(x)], axis=-1)


def write_png(path, image):
    rows = b"".join(b"\0" + row.tobytes() for row in image)

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", image.shape[1], image.shape[0], 16, 0, 0, 0, 0)
    path.write_bytes(
        b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 6)) + chunk(b"IEND", b"")
    )


def first_hit(origin, rays):
    """Distance along each ray and the normal there; infinite where nothing is hit. Object frame."""
    along = rays @ PLANE_NORMAL
    with np.errstate(divide="ignore", invalid="ignore"):
        plane = np.where(along < 0, ((PLANE_POINT - origin) @ PLANE_NORMAL) / along, np.inf)
    a = np.sum(rays * rays, axis=-1)
    half_b = rays @ (origin - SPHERE_CENTER)
    root = half_b**2 - a * (np.sum((origin - SPHERE_CENTER) ** 2) - SPHERE_RADIUS**2)
    sphere = np.where(root > 0, (-half_b - np.sqrt(np.maximum(root, 0))) / a, np.inf)
    plane = np.where(plane > 0, plane, np.inf)
    sphere = np.where(sphere > 0, sphere, np.inf)
    distance = np.minimum(plane, sphere)
    safe = np.where(np.isfinite(distance), distance, 0.0)
    points = origin + rays * safe[..., None]
    normals = np.where((sphere < plane)[..., None], (points - SPHERE_CENTER) / SPHERE_RADIUS, PLANE_NORMAL)
    return distance, points, normals


def main():
    global PLANE_NORMAL
    PLANE_NORMAL = unit(PLANE_NORMAL)
    folder = pathlib.Path(sys.argv[1])
    axis = unit(AXIS)
    # x of the object frame points from the axis towards the camera's centre, the origin of the rig frame.
    x_axis = unit(-AXIS_POINT - axis * (-AXIS_POINT @ axis))
    object_axes = np.column_stack([x_axis, np.cross(axis, x_axis), axis])
    projector = projector_rotation()
    rays_rig = camera_rays()
    views = []
    for index, angle_deg in enumerate(ANGLES_DEG):
        rig_from_object = rotation_about(axis, np.radians(angle_deg)) @ object_axes
        to_object = rig_from_object.T
        camera_object = to_object @ -AXIS_POINT
        distance, points, normals = first_hit(camera_object, rays_rig @ to_object.T)
        hit = np.isfinite(distance)
        # Light: the projector's point of view decides on field and shadow.
        source = to_object @ (PROJECTOR_POSITION - AXIS_POINT)
        to_points = points - source
        shadow_distance, _, _ = first_hit(source, to_points)
        lit = hit & (shadow_distance > 1 - 1e-6)
        in_projector = (to_points @ rig_from_object.T) @ projector.T
        with np.errstate(divide="ignore", invalid="ignore"):
            column = PROJECTOR_F * in_projector[..., 0] / in_projector[..., 2] + PROJECTOR_CX
            row = PROJECTOR_F * in_projector[..., 1] / in_projector[..., 2] + PROJECTOR_CY
        lit &= (in_projector[..., 2] > 0) & (column > -0.5) & (column < PROJECTOR_SIZE[0] - 0.5)
        lit &= (row > -0.5) & (row < PROJECTOR_SIZE[1] - 0.5)
        lengths = np.linalg.norm(to_points, axis=-1)
        shading = np.maximum(0.0, -np.sum(to_points * normals, axis=-1) / np.maximum(lengths, 1e-9))
        light = np.where(lit, 1500.0 * shading, 0.0)
        view = folder / "views" / str(index)
        view.mkdir(parents=True)
        noise = np.random.default_rng(index)
        for number, period in enumerate(PERIODS_PX):
            for shift in range(SHIFTS):
                phase = 2 * np.pi * (np.where(lit, column, 0.0) / period + shift / SHIFTS)
                counts = 60.0 + light * (1 + 0.85 * np.cos(phase)) + noise.normal(0.0, 2.0, light.shape)
                image = np.clip(np.rint(counts), 0, 4095).astype(">u2")
                write_png(view / f"p{number}-{shift}.png", image)
        views.append(f'[[view]]\nangle_deg = {angle_deg}\nfolder = "views/{index}"\n')
    rows = ", ".join("[" + ", ".join(repr(float(x)) for x in row) + "]" for row in projector)
    (folder / "rig.toml").write_text(
        f"""format = "frangia-rig"
version = 1
[camera]
size_px = [{WIDTH}, {HEIGHT}]
focal_px = [{FX}, {FY}]
principal_point_px = [{CX}, {CY}]
distortion = [{K1}, {K2}, {P1}, {P2}, {K3}]
white_level = 4095
[projector]
model = "pinhole"
position_mm = {[float(x) for x in PROJECTOR_POSITION]}
rotation = [{rows}]
size_px = {list(PROJECTOR_SIZE)}
focal_px = [{PROJECTOR_F}, {PROJECTOR_F}]
principal_point_px = [{PROJECTOR_CX}, {PROJECTOR_CY}]
[turntable]
point_mm = {[float(x) for x in AXIS_POINT]}
axis = {[float(x) for x in axis]}
"""
    )
    patterns = "".join(
        f'[[pattern]]\nname = "p{i}"\nkind = "fringe"\nperiod_px = {period}\n'
        f"shifts_deg = {[360.0 * k / SHIFTS for k in range(SHIFTS)]}\n"
        for i, period in enumerate(PERIODS_PX)
    )
    (folder / "scan.toml").write_text(
        'format = "frangia-scan"\nversion = 2\nname = "plane and sphere"\n' + patterns + "".join(views)
    )
    # The truth, for the test: sphere centre and radius, plane point and normal, object frame.
    (folder / "truth.txt").write_text(
        " ".join(repr(float(x)) for x in [*SPHERE_CENTER, SPHERE_RADIUS, *PLANE_POINT, *PLANE_NORMAL]) + "\n"
    )


main()
