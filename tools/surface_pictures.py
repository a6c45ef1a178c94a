"""Makes the pictures of docs/surface.md: python3 tools/surface_pictures.py PROGRAM docs/images

The program simulates, reconstructs and draws the parts. This script adds the meshes of single views, and the
distance field with marching cubes that the edge of the block is compared with. Names after the folder
(registration, setups, sigma_and_closing, block_edge) select pictures.
"""
import json
import math
import pathlib
import subprocess
import sys
import tempfile

import numpy
from PIL import Image, ImageDraw, ImageFont
from skimage.measure import marching_cubes

sys.path.append(str(pathlib.Path(__file__).resolve().parent / "figures"))

from scans import Scans  # noqa: E402

PROGRAM = pathlib.Path(sys.argv[1]).resolve()
IMAGES = pathlib.Path(sys.argv[2])
WORK = pathlib.Path(tempfile.mkdtemp(prefix="frangia-surface-pictures-"))


def run(*arguments):
    result = subprocess.run([PROGRAM, "--json", *map(str, arguments)], check=True, capture_output=True, text=True)
    return json.loads(result.stdout) if result.stdout.strip() else {}


def simulate(part, *options):
    return Scans(PROGRAM).made("simulate", part, "--rig", "digital", "--samples", 4, *options)


class Rig:
    """Camera and turntable of rig.toml, to transform a depth image into points of the object frame."""

    def __init__(self, path):
        import tomllib

        table = tomllib.loads(path.read_text())
        camera = table["camera"]
        self.size = camera["size_px"]
        self.focal = camera["focal_px"]
        self.centre = camera["principal_point_px"]
        self.lens = (camera.get("distortion", []) + [0.0] * 5)[:5]
        self.point = numpy.array(table["turntable"]["point_mm"], float)
        self.axis = numpy.array(table["turntable"]["axis"], float)

    def rays(self):
        k1, k2, p1, p2, k3 = self.lens
        u, v = numpy.meshgrid(numpy.arange(self.size[0]), numpy.arange(self.size[1]))
        xd, yd = (u - self.centre[0]) / self.focal[0], (v - self.centre[1]) / self.focal[1]
        x, y = xd.copy(), yd.copy()
        for _ in range(20):
            r2 = x * x + y * y
            radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3))
            x, y = (
                (xd - 2 * p1 * x * y - p2 * (r2 + 2 * x * x)) / radial,
                (yd - p1 * (r2 + 2 * y * y) - 2 * p2 * x * y) / radial,
            )
        return numpy.stack([x, y, numpy.ones_like(x)], axis=-1)

    def project(self, points):
        k1, k2, p1, p2, k3 = self.lens
        x, y = points[..., 0] / points[..., 2], points[..., 1] / points[..., 2]
        r2 = x * x + y * y
        radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3))
        u = self.centre[0] + self.focal[0] * (x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x))
        v = self.centre[1] + self.focal[1] * (y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y)
        return u, v

    def frame(self, axis, point):
        x = -point - axis * (-point @ axis)
        x /= numpy.linalg.norm(x)
        return numpy.stack([x, numpy.cross(axis, x), axis], axis=1)

    def to_object(self, points, angle_deg, axis=None, point=None):
        axis = self.axis if axis is None else axis
        point = self.point if point is None else point
        a = math.radians(angle_deg)
        turn = numpy.array([[math.cos(a), -math.sin(a), 0], [math.sin(a), math.cos(a), 0], [0, 0, 1]])
        return (points - point) @ self.frame(axis, point) @ turn

    def to_rig(self, points, angle_deg):
        a = math.radians(angle_deg)
        turn = numpy.array([[math.cos(a), -math.sin(a), 0], [math.sin(a), math.cos(a), 0], [0, 0, 1]])
        return points @ turn.T @ self.frame(self.axis, self.point).T + self.point


def depth_of(scan, view):
    folder = WORK / f"decoded-{scan.name}-{view}"
    run("decode", scan, "--view", view, "-o", folder)
    return numpy.array(Image.open(folder / "depth.tiff"), float)


def triangles_of(depth, steepest_mm):
    """Returns both triangles of every quad of measured pixels without a depth step."""
    number = numpy.arange(depth.size).reshape(depth.shape)
    corners = numpy.stack([depth[:-1, :-1], depth[:-1, 1:], depth[1:, 1:], depth[1:, :-1]])
    whole = numpy.isfinite(corners).all(0) & (numpy.ptp(corners, axis=0) < steepest_mm)
    a, b, c, d = number[:-1, :-1][whole], number[:-1, 1:][whole], number[1:, 1:][whole], number[1:, :-1][whole]
    return numpy.concatenate([numpy.stack([a, d, b], 1), numpy.stack([b, d, c], 1)])


def write_ply(path, vertices, label, triangles):
    kind = numpy.dtype([("x", "<f4"), ("y", "<f4"), ("z", "<f4"), ("views", "<u2")])
    rows = numpy.zeros(len(vertices), kind)
    rows["x"], rows["y"], rows["z"] = vertices.T
    rows["views"] = label
    faces = numpy.zeros(len(triangles), numpy.dtype([("n", "u1"), ("v", "<i4", 3)]))
    faces["n"], faces["v"] = 3, triangles
    head = (
        f"ply\nformat binary_little_endian 1.0\nelement vertex {len(rows)}\nproperty float x\nproperty float y\n"
        f"property float z\nproperty ushort views\nelement face {len(faces)}\n"
        "property list uchar int vertex_indices\nend_header\n"
    )
    path.write_bytes(head.encode() + rows.tobytes() + faces.tobytes())


def combine_views(path, rig, depths, places, label=lambda number: number + 1):
    """Writes all views as one mesh. Each vertex has the label of its view."""
    rays, vertices, labels, triangles, count = rig.rays(), [], [], [], 0
    for number, depth in enumerate(depths):
        points = places(rays * depth[..., None], number).reshape(-1, 3)
        used, faces = numpy.unique(triangles_of(depth, 1.5), return_inverse=True)
        vertices.append(points[used])
        labels.append(numpy.full(len(used), label(number)))
        triangles.append(faces.reshape(-1, 3) + count)
        count += len(used)
    write_ply(path, numpy.concatenate(vertices), numpy.concatenate(labels), numpy.concatenate(triangles))


WIDTH = 1800  # of a sheet, px; pages show it at about half of that
CAPTION = ImageFont.truetype("DejaVuSans.ttf", 44)


def side_by_side(path, pictures):
    """Places pictures side by side, each below its caption."""
    each = WIDTH // len(pictures)
    images = [Image.open(picture).convert("RGB") for picture, _ in pictures]
    images = [image.resize((each, round(image.height * each / image.width)), Image.LANCZOS) for image in images]
    head = 76
    sheet = Image.new("RGB", (each * len(images), head + images[0].height), "white")
    draw = ImageDraw.Draw(sheet)
    for i, (image, (_, title)) in enumerate(zip(images, pictures)):
        sheet.paste(image, (i * each, head))
        width = draw.textlength(title, font=CAPTION)
        if width > each - 20:
            raise SystemExit(f"{path.name}: the caption '{title}' is too long")
        draw.text((i * each + (each - width) / 2, 10), title, fill=(40, 40, 40), font=CAPTION)
    sheet.save(path, optimize=True)


def middle_of(picture, box):
    """Crops a picture to a box, given as fractions of its size."""
    image = Image.open(picture)
    image.crop(tuple(round(share * size) for share, size in zip(box, image.size * 2))).save(picture)
    return picture


HALF = (0.25, 0.02, 0.75, 0.98)  # the box of an upright part


def registration():
    scan = simulate("bust", "--axis-offset", 0.5, "--axis-tilt", 0.3, "--angle-error", 0.15)
    mesh = WORK / "misaligned.ply"
    answer = run("reconstruct", scan, "-o", mesh)["registration"]
    rig = Rig(scan / "rig.toml")
    depths = [depth_of(scan, view) for view in range(8)]
    axis, point = numpy.array(answer["axis"]), numpy.array(answer["point_mm"])

    def before(points, view):
        return rig.to_object(points, 45.0 * view)

    def after(points, view):
        return rig.to_object(points, answer["angles_deg"][view], axis, point)

    for name, places in (("before", before), ("after", after)):
        combine_views(WORK / f"{name}.ply", rig, depths, places)
        run("inspect", WORK / f"{name}.ply", "--show", "views", "--no-legend", "--picture", WORK / f"{name}.png")
    side_by_side(
        IMAGES / "surface-registration.png",
        [
            (middle_of(WORK / "before.png", HALF), f"poses of the rig: {answer['rms_before_mm']:.2f} mm"),
            (middle_of(WORK / "after.png", HALF), f"registered: {answer['rms_after_mm']:.3f} mm"),
        ],
    )


def sigma_and_closing():
    scan = simulate("bust")
    mesh, closed = WORK / "bust.ply", WORK / "closed.ply"
    run("reconstruct", scan, "-o", mesh)
    run("reconstruct", scan, "-o", closed, "--watertight")
    run("inspect", mesh, "--show", "sigma", "--scale", 0.02, "--no-legend", "--picture", WORK / "sigma.png")
    run(
        "inspect",
        mesh,
        "--reference",
        scan / "truth.ply",
        "--scale",
        0.02,
        "--no-legend",
        "--picture",
        WORK / "error.png",
    )
    side_by_side(
        IMAGES / "surface-sigma.png",
        [
            (middle_of(WORK / "sigma.png", HALF), "predicted sigma: 0 to 0.02 mm"),
            (middle_of(WORK / "error.png", HALF), "true error: -0.02 to 0.02 mm"),
        ],
    )
    run("inspect", mesh, "--show", "shape", "--from", "60,-35", "--no-legend", "--picture", WORK / "open.png")
    run("inspect", closed, "--show", "marks", "--from", "60,-35", "--no-legend", "--picture", WORK / "marks.png")
    side_by_side(
        IMAGES / "surface-watertight.png",
        [
            (middle_of(WORK / "open.png", HALF), "measured, from below"),
            (middle_of(WORK / "marks.png", HALF), "--watertight: blue is synthesized"),
        ],
    )


def stations_of(scan):
    """Returns the angle and the setup of each view."""
    import tomllib

    views = tomllib.loads((scan / "scan.toml").read_text())["view"]
    return [view["angle_deg"] for view in views], [view.get("setup", 0) for view in views]


def setups():
    """Draws the bracket standing and lying: with unchanged pose, and with aligned setups."""
    scan = simulate("bracket", "--setups", 90)
    answer = run("reconstruct", scan, "-o", WORK / "setups.ply")["registration"]
    rig = Rig(scan / "rig.toml")
    angles, setup_of = stations_of(scan)
    depths = [depth_of(scan, view) for view in range(len(angles))]
    axis, point = numpy.array(answer["axis"]), numpy.array(answer["point_mm"])
    part_pose = numpy.array(answer["part_poses"][0])

    def on_table(points, view):
        return rig.to_object(points, answer["angles_deg"][view], axis, point)

    def aligned(points, view):
        on_turntable = on_table(points, view)
        return on_turntable if setup_of[view] == 0 else (on_turntable - part_pose[:, 3]) @ part_pose[:, :3]

    pictures = []
    for name, places in (("moved", on_table), ("aligned", aligned)):
        combine_views(WORK / f"{name}.ply", rig, depths, places, lambda view: 1 + 4 * setup_of[view])
        run(
            "inspect",
            WORK / f"{name}.ply",
            "--show",
            "views",
            "--no-legend",
            "--picture",
            WORK / f"{name}.png",
            "--from",
            "50,25",
        )
        pictures.append(middle_of(WORK / f"{name}.png", (0.18, 0.02, 0.82, 0.98)))
    side_by_side(
        IMAGES / "surface-setups.png",
        [(pictures[0], "two setups: standing and lying"), (pictures[1], "aligned by their shape")],
    )


def write_block(path):
    half, height = (25.0, 18.0), 30.0
    corners = [[x, y, z] for z in (0.0, height) for y in (-half[1], half[1]) for x in (-half[0], half[0])]
    quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (1, 3, 7, 5), (3, 2, 6, 7), (2, 0, 4, 6)]
    faces = [(a, b, c) for a, b, c, _ in quads] + [(a, c, d) for a, _, c, d in quads]
    write_ply(path, numpy.array(corners), numpy.ones(len(corners)), numpy.array(faces))


def normals_of(points):
    """Computes normals from the neighbouring points, towards the camera."""
    right, down = numpy.gradient(points, axis=1), numpy.gradient(points, axis=0)
    normal = numpy.cross(down, right)
    normal /= numpy.maximum(numpy.linalg.norm(normal, axis=-1, keepdims=True), 1e-12)
    return numpy.where((normal * points).sum(-1, keepdims=True) > 0, -normal, normal)


def block_edge():
    """Draws a corner of the block with sharp edges: by Frangia, and by marching cubes in a usual distance field.

    The field holds distances along the normals, weighted by the cosine of incidence, with less weight behind the
    surface. A cell with an unknown corner stays open.
    """
    write_block(WORK / "block-part.ply")
    scan = simulate(WORK / "block-part.ply")
    voxel = 0.5
    run("reconstruct", scan, "-o", WORK / "block.ply", "--voxel", voxel)
    rig = Rig(scan / "rig.toml")
    axes = [numpy.arange(low, high, voxel) for low, high in ((-28.0, 28.0), (-21.0, 21.0), (2.0, 33.0))]
    grid = numpy.stack(numpy.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    total, weight = numpy.zeros(len(grid)), numpy.zeros(len(grid))
    rays = rig.rays()
    for view, angle in enumerate(stations_of(scan)[0]):
        points = rays * depth_of(scan, view)[..., None]
        normals = normals_of(points)
        seen = rig.to_rig(grid, angle)
        u, v = rig.project(seen)
        x, y = numpy.rint(u).astype(int), numpy.rint(v).astype(int)
        inside = (x >= 0) & (y >= 0) & (x < rig.size[0]) & (y < rig.size[1])
        x, y = numpy.where(inside, x, 0), numpy.where(inside, y, 0)
        distance = ((seen - points[y, x]) * normals[y, x]).sum(-1)
        cosine = -(normals[y, x] * rays[y, x]).sum(-1) / numpy.linalg.norm(rays[y, x], axis=-1)
        near = inside & (numpy.abs(distance) < 4 * voxel) & (cosine > 0.1)
        trust = cosine**2 / (1 + numpy.minimum(distance / voxel, 0) ** 2) ** 2
        total[near] += (trust * distance)[near]
        weight[near] += trust[near]
    shape = tuple(len(a) for a in axes)
    field = numpy.where(weight > 0, total / numpy.maximum(weight, 1e-12), numpy.nan).reshape(shape)
    known = numpy.isfinite(field)
    cells = numpy.ones(tuple(n - 1 for n in shape), bool)
    for corner in numpy.ndindex(2, 2, 2):
        cells &= known[tuple(slice(c, n - 1 + c) for c, n in zip(corner, shape))]
    mask = numpy.zeros(shape, bool)
    mask[1:, 1:, 1:] = cells  # marching_cubes indexes a cell by its last corner
    low = numpy.array([a[0] for a in axes])
    vertices, faces, _, _ = marching_cubes(numpy.nan_to_num(field, nan=9.0), 0.0, mask=mask)
    vertices = vertices * voxel + low
    cross = numpy.cross(vertices[faces[:, 1]] - vertices[faces[:, 0]], vertices[faces[:, 2]] - vertices[faces[:, 0]])
    outward = vertices[faces].mean(1) - numpy.array([0.0, 0.0, 15.0])
    if (cross * outward).sum() < 0:
        faces = faces[:, ::-1]
    write_ply(WORK / "cubes.ply", vertices, numpy.ones(len(vertices)), faces)
    pictures = []
    for name in ("block", "cubes"):
        run(
            "inspect",
            WORK / f"{name}.ply",
            "--show",
            "shape",
            "--from",
            "35,30",
            "--no-legend",
            "--picture",
            WORK / f"{name}.png",
        )
        pictures.append(middle_of(WORK / f"{name}.png", (0.36, 0.24, 0.64, 0.66)))
    side_by_side(
        IMAGES / "surface-edge.png",
        [(pictures[0], "Frangia, 0.5 mm"), (pictures[1], "marching cubes, 0.5 mm")],
    )


IMAGES.mkdir(parents=True, exist_ok=True)
ONLY = sys.argv[3:]  # names of the pictures; all of them when it is empty
for wanted in (registration, setups, sigma_and_closing, block_edge):
    if not ONLY or wanted.__name__ in ONLY:
        wanted()
