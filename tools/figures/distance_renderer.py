"""Scans whose frames owe nothing to the program: parts are distance functions, and rays are marched through them.

Camera, projector, turntable and fringes follow docs/scan-format.md. Lengths are in mm, the object frame has z up.
"""
import copy

import cv2
import numpy as np

import surfaces

NO_MOTION = (np.eye(3), np.zeros(3))


def unit(vector):
    return np.asarray(vector, float) / np.linalg.norm(vector)


def turned(axis, angle_rad):
    """The rotation about a unit axis (Rodrigues)."""
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle_rad) * cross + (1 - np.cos(angle_rad)) * cross @ cross


# Parts: the distance of points (n x 3) to the surface, negative inside, or a bound of it.


def bracket(p):
    base = surfaces.box(p, (-32, -22, 0), (32, 22, 10))
    wall = surfaces.box(p, (-32, -22, 0), (-20, 22, 50))
    rib = surfaces.box(p, (-22, -3, 6), (2, 3, 26))
    return np.maximum(np.minimum.reduce([base, wall, rib]), -surfaces.cylinder(p, 15, 0, 7, -1, 20))


def shaft(p):
    steps = [surfaces.cylinder(p, 0, 0, radius, *z) for radius, *z in ((25, 0, 30), (17, 30, 55), (12, 55, 70))]
    return np.maximum(np.minimum.reduce(steps), -surfaces.box(p, (12, -4, 39), (22, 4, 51)))


def bust(p):
    from_centre = p - [0, 0, 35]
    distance = np.maximum(np.linalg.norm(from_centre, axis=1), 1e-9)
    x, y, z = (from_centre / distance[:, None]).T
    waves = 2.2 * np.sin(5 * z + 3 * x) + 1.3 * np.sin(9 * y + 2 * z) * x
    return 0.75 * (distance - (30 + 3 * x**2 - 4 * y**3 + waves))


def ball_bar(p):
    balls = [np.linalg.norm(p - [x, 0, 30], axis=1) - 20 for x in (-35, 35)]
    return np.minimum.reduce([*balls, surfaces.box(p, (-30, -5, 25), (30, 5, 35))])


def cup(p):
    wall = np.maximum(surfaces.cylinder(p, 0, 0, 26, 0, 58), -surfaces.cylinder(p, 0, 0, 22.5, 4, 70))
    from_ring = np.stack([np.hypot(p[:, 0] - 27, p[:, 2] - 30) - 15, p[:, 1]], axis=1)
    outside = 24 - np.hypot(p[:, 0], p[:, 1])
    return np.minimum(wall, np.maximum(np.linalg.norm(from_ring, axis=1) - 3.5, outside))


def gear(p):
    """14 teeth about a hub; the slope of their flanks bounds the distance."""
    radius, angle = np.hypot(p[:, 0], p[:, 1]), np.arctan2(p[:, 1], p[:, 0])
    rim = 0.27 * (radius - 28 - 4 * np.clip(1.8 * np.sin(14 * angle), -1, 1))
    teeth = np.maximum(rim, np.abs(p[:, 2] - 10) - 10)
    bore = np.minimum(surfaces.cylinder(p, 0, 0, 7, -1, 40), surfaces.box(p, (0, -2.5, -1), (9.5, 2.5, 40)))
    return np.maximum(np.minimum(teeth, surfaces.cylinder(p, 0, 0, 14, 0, 36)), -bore)


PARTS = {"ball bar": ball_bar, "bracket": bracket, "bust": bust, "cup": cup, "gear": gear, "shaft": shaft}
CENTRE, RADIUS = np.array([0, 0, 30]), 75  # of a sphere around each


def gradients(part, points, step=1e-4):
    moved = [(part(points + offset) - part(points - offset)) / (2 * step) for offset in np.eye(3) * step]
    return np.stack(moved, axis=1)


def march(part, origin, directions, near, far):
    """The distances along unit directions to the first hit, infinite where there is none (sphere tracing)."""
    reached, hit, left = near.copy(), np.zeros(len(directions), bool), np.arange(len(directions))
    for _ in range(160):
        gap = part(origin + directions[left] * reached[left, None])
        hit[left[gap < 1e-4]] = True
        reached[left] += np.where(gap < 1e-4, 0, gap)
        left = left[(gap >= 1e-4) & (reached[left] < far[left])]
        if len(left) == 0:
            break
    return np.where(hit, reached, np.inf)


class Rig:
    """A camera at the origin, a projector with vertical fringes, a turntable. A changed copy is a rig that moved."""

    def __init__(self):
        self.size, self.focal, self.principal = (480, 384), 900.0, np.array([241.3, 188.6])
        self.shown_size, self.shown_focal, self.shown_principal = (1280, 800), 2100.0, np.array([641.0, 402.0])
        self.axis_point, self.axis = np.array([2.0, 22.0, 400.0]), unit([0.02, -0.9, -0.42])
        self.position = np.array([140.0, -10.0, 10.0])
        forward = unit(self.axis_point - [0, 28, 0] - self.position)
        right = unit(np.cross([0.03, 1, 0], forward))
        self.projector = np.array([right, np.cross(forward, right), forward])
        towards = unit(-self.axis_point - self.axis * (-self.axis_point @ self.axis))
        self.object_axes = np.column_stack([towards, np.cross(self.axis, towards), self.axis])

    def with_projector_moved(self, angle_deg, length_mm):
        moved = copy.deepcopy(self)
        moved.projector = self.projector @ turned(unit([0.2, 1, 0.1]), np.radians(angle_deg)).T
        moved.position = self.position + length_mm * unit([0.6, 0.3, -0.7])
        return moved

    def toml(self):
        def listed(values):
            return [float(value) for value in values]

        return f"""format = "frangia-rig"
version = 1
[camera]
size_px = {list(self.size)}
focal_px = [{self.focal}, {self.focal}]
principal_point_px = {listed(self.principal)}
distortion = [0, 0, 0, 0, 0]
white_level = 4095
[projector]
model = "pinhole"
position_mm = {listed(self.position)}
rotation = {[listed(row) for row in self.projector]}
size_px = {list(self.shown_size)}
focal_px = [{self.shown_focal}, {self.shown_focal}]
principal_point_px = {listed(self.shown_principal)}
[turntable]
point_mm = {listed(self.axis_point)}
axis = {listed(self.axis)}
"""


def white(points):
    return 1.0


def seen(part, rig, angle_deg, part_motion=NO_MOTION, table_motion=NO_MOTION, paint=white, across=2, radius=RADIUS):
    """Projector column and shading of `across`² points of each pixel, the shading 0 where no light comes from.

    The part moved on its table (object frame), the table in the rig's frame; both are (rotation, translation). `paint` gives
    the albedo of points; nothing is seen of the part beyond `radius` around CENTRE.
    """
    pose = table_motion[0] @ turned(rig.axis, np.radians(angle_deg)) @ rig.object_axes
    centre = rig.axis_point + table_motion[1]
    to_object = part_motion[0].T @ pose.T
    offset = -to_object @ centre - part_motion[0].T @ part_motion[1]
    source = to_object @ rig.position + offset
    samples = []
    for j, i in np.ndindex(across, across):
        u, v = np.meshgrid(*(np.arange(n) + (k + 0.5) / across - 0.5 for n, k in zip(rig.size, (i, j))))
        rays = np.stack([u - rig.principal[0], v - rig.principal[1], np.full_like(u, rig.focal)], axis=-1)
        directions = rays.reshape(-1, 3) @ to_object.T
        directions /= np.linalg.norm(directions, axis=1)[:, None]
        half = directions @ (offset - CENTRE)
        room = half**2 - (offset - CENTRE) @ (offset - CENTRE) + radius**2
        index = np.flatnonzero(room > 0)
        half, root = half[index], np.sqrt(room[index])
        distance = march(part, offset, directions[index], -half - root, -half + root)
        index, distance = index[np.isfinite(distance)], distance[np.isfinite(distance)]
        points = offset + directions[index] * distance[:, None]
        away = points - source
        length = np.linalg.norm(away, axis=1)
        away /= length[:, None]
        normals = gradients(part, points)
        normals /= np.linalg.norm(normals, axis=1)[:, None]
        lit = march(part, source, away, length - 2 * radius, length + 1) > length - 0.05
        x, y, z = (((points - offset) @ to_object - rig.position) @ rig.projector.T).T
        column = rig.shown_focal * x / z + rig.shown_principal[0]
        row = rig.shown_focal * y / z + rig.shown_principal[1]
        for at, size in ((column, rig.shown_size[0]), (row, rig.shown_size[1])):
            lit &= (at > -0.5) & (at < size - 0.5)
        columns, shading = np.zeros(len(directions)), np.zeros(len(directions))
        columns[index] = column
        shading[index] = paint(points) * np.where(lit, np.maximum(0, -(away * normals).sum(axis=1)), 0)
        samples.append((columns.reshape(u.shape), shading.reshape(u.shape)))
    return samples


PERIODS_PX, SHIFTS_DEG = [1280.0, 160.0, 20.0], [0.0, 90.0, 180.0, 270.0]


def frames(samples, generator, ambient=60.0, light=1500.0, read=2.0, gain=0.15, blur_px=0.0):
    """12-bit frames of each period and shift by a lens of a normal blur; noise of photons and of reading."""
    images = []
    for period in PERIODS_PX:
        for shift in SHIFTS_DEG:
            total = 0.0
            for column, shading in samples:
                wave = 0.5 + 0.5 * np.cos(2 * np.pi * column / period + np.radians(shift))
                total = total + ambient + 2 * light * shading * (0.03 + 0.97 * wave)
            total = total / len(samples)
            if blur_px > 0:
                total = cv2.GaussianBlur(total, (0, 0), blur_px)
            counts = total + generator.normal(size=total.shape) * np.sqrt(read**2 + gain * total)
            images.append(np.clip(np.rint(counts), 0, 4095).astype(np.uint16))
    return images


def write_scan(folder, rig, angles_deg, views):
    """A scan folder of `views` (lists of frames) as if `rig` and `angles_deg` were true."""
    text = ['format = "frangia-scan"\nversion = 2\nname = "rendered elsewhere"']
    for i, period in enumerate(PERIODS_PX):
        text.append(f'[[pattern]]\nname = "p{i}"\nkind = "fringe"\nperiod_px = {period}\nshifts_deg = {SHIFTS_DEG}')
    for k, (angle, images) in enumerate(zip(angles_deg, views)):
        text.append(f'[[view]]\nangle_deg = {angle}\nfolder = "views/{k}"')
        view = folder / "views" / str(k)
        view.mkdir(parents=True)
        for n, image in enumerate(images):
            i, j = divmod(n, len(SHIFTS_DEG))
            cv2.imwrite(str(view / f"p{i}-{j}.png"), image, [cv2.IMWRITE_PNG_COMPRESSION, 1])
    (folder / "rig.toml").write_text(rig.toml())
    (folder / "scan.toml").write_text("\n".join(text) + "\n")


def errors(part, points):
    """The distances of points to a part after the rigid motion that fits best: the part's place rests on the table's."""
    for _ in range(12):
        slopes = gradients(part, points)
        steepness = np.maximum(np.linalg.norm(slopes, axis=1), 1e-6)
        error, normals = part(points) / steepness, slopes / steepness[:, None]
        weights = 1 / (1 + (error / max(1e-3, 3 * np.median(np.abs(error)))) ** 2)
        rows = np.hstack([normals, np.cross(points, normals)])
        weighted = (rows * weights[:, None]).T
        step = -np.linalg.solve(weighted @ rows + 1e-9 * np.eye(6), weighted @ error)
        angle = np.linalg.norm(step[3:])
        points = points @ turned(step[3:] / max(angle, 1e-30), angle).T + step[:3]
        if np.abs(step).max() < 1e-6:
            break
    return error
