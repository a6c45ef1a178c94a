"""Makes the pictures of docs/surface.md: python3 tools/surface_pictures.py PROGRAM docs/images

Scans of simulated parts are made, reconstructed and drawn by the program itself; what is only here is the
putting together of single views, and the plain field with marching cubes that the block's edge is compared with.
"""
import json
import math
import pathlib
import subprocess
import sys
import tempfile

import numpy
from PIL import Image, ImageDraw
from skimage.measure import marching_cubes

PROGRAM = pathlib.Path(sys.argv[1]).resolve()
IMAGES = pathlib.Path(sys.argv[2])
WORK = pathlib.Path(tempfile.mkdtemp(prefix="frangia-surface-pictures-"))


def run(*arguments):
    result = subprocess.run([PROGRAM, "--json", *map(str, arguments)], check=True, capture_output=True, text=True)
    return json.loads(result.stdout) if result.stdout.strip() else {}


def simulate(part, name, *options):
    scan = WORK / name
    run("simulate", part, "--rig", "digital", "--samples", 4, "-o", scan, *options)
    return scan


class Rig:
    """The parts of rig.toml that turn a depth image into points of the object frame."""

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
    """Both halves of every quad of measured pixels without a depth step."""
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


def put_together(path, rig, depths, places):
    """All views as one mesh, each vertex labelled with its view's number."""
    rays, vertices, labels, triangles, count = rig.rays(), [], [], [], 0
    for number, depth in enumerate(depths):
        points = places(rays * depth[..., None], number).reshape(-1, 3)
        used, faces = numpy.unique(triangles_of(depth, 1.5), return_inverse=True)
        vertices.append(points[used])
        labels.append(numpy.full(len(used), number + 1))
        triangles.append(faces.reshape(-1, 3) + count)
        count += len(used)
    write_ply(path, numpy.concatenate(vertices), numpy.concatenate(labels), numpy.concatenate(triangles))


def side_by_side(path, pictures):
    images = [Image.open(picture).convert("RGB") for picture, _ in pictures]
    sheet = Image.new("RGB", (sum(i.width for i in images), images[0].height), "white")
    draw = ImageDraw.Draw(sheet)
    left = 0
    for image, (_, title) in zip(images, pictures):
        sheet.paste(image, (left, 0))
        draw.text((left + 24, 18), title, fill=(40, 40, 40), font_size=26)
        left += image.width
    sheet.thumbnail((1600, 1600))
    sheet.save(path, optimize=True)


def registration():
    scan = simulate("bust", "worn", "--axis-offset", 0.5, "--axis-tilt", 0.3, "--angle-error", 0.15)
    mesh = WORK / "worn.ply"
    answer = run("reconstruct", scan, "-o", mesh)["registration"]
    rig = Rig(scan / "rig.toml")
    depths = [depth_of(scan, view) for view in range(8)]
    axis, point = numpy.array(answer["axis"]), numpy.array(answer["point_mm"])
    before = lambda points, view: rig.to_object(points, 45.0 * view)
    after = lambda points, view: rig.to_object(points, answer["angles_deg"][view], axis, point)
    pictures = []
    for name, places in (("before", before), ("after", after)):
        put_together(WORK / f"{name}.ply", rig, depths, places)
        run("inspect", WORK / f"{name}.ply", "--show", "views", "--picture", WORK / f"{name}.png")
    side_by_side(
        IMAGES / "surface-registration.png",
        [
            (WORK / "before.png", f"as the rig says: {answer['rms_before_mm']:.2f} mm RMS apart"),
            (WORK / "after.png", f"registered: {answer['rms_after_mm']:.3f} mm"),
        ],
    )


def sigma_and_closing():
    scan = simulate("bust", "bust")
    mesh, closed = WORK / "bust.ply", WORK / "closed.ply"
    run("reconstruct", scan, "-o", mesh)
    run("reconstruct", scan, "-o", closed, "--watertight")
    run("inspect", mesh, "--show", "sigma", "--scale", 0.02, "--picture", WORK / "sigma.png")
    run("inspect", mesh, "--reference", scan / "truth.ply", "--scale", 0.02, "--picture", WORK / "error.png")
    side_by_side(
        IMAGES / "surface-sigma.png",
        [(WORK / "sigma.png", "predicted sigma, 0 to 0.02 mm"), (WORK / "error.png", "the true error, -0.02 to 0.02 mm")],
    )
    run("inspect", mesh, "--show", "shape", "--from", "60,-35", "--picture", WORK / "open.png")
    run("inspect", closed, "--show", "marks", "--from", "60,-35", "--picture", WORK / "marks.png")
    side_by_side(
        IMAGES / "surface-watertight.png",
        [(WORK / "open.png", "what was seen, from below"), (WORK / "marks.png", "--watertight: red was invented")],
    )


def block_edge():
    """The upper edge of the bracket's plate, cut out: ours, and marching cubes of a plain field of the same views."""
    scan = simulate("bracket", "bracket")
    voxel = 0.5
    mesh = WORK / "bracket.ply"
    run("reconstruct", scan, "-o", mesh, "--voxel", voxel)
    rig = Rig(scan / "rig.toml")
    depths = [depth_of(scan, view) for view in range(8)]
    low, high = numpy.array([-40.0, -40.0, -2.0]), numpy.array([40.0, 40.0, 70.0])
    axes = [numpy.arange(low[i], high[i], voxel) for i in range(3)]
    grid = numpy.stack(numpy.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    total, weight = numpy.zeros(len(grid)), numpy.zeros(len(grid))
    truncation = 3 * voxel
    for view, depth in enumerate(depths):
        seen = rig.to_rig(grid, 45.0 * view)
        u, v = rig.project(seen)
        x, y = numpy.rint(u).astype(int), numpy.rint(v).astype(int)
        inside = (x >= 0) & (y >= 0) & (x < depth.shape[1]) & (y < depth.shape[0])
        measured = numpy.full(len(grid), numpy.nan)
        measured[inside] = depth[y[inside], x[inside]]
        distance = measured - seen[:, 2]
        near = numpy.abs(distance) < truncation
        total[near] += distance[near]
        weight[near] += 1
    shape = tuple(len(a) for a in axes)
    field = numpy.where(weight > 0, total / numpy.maximum(weight, 1), numpy.nan).reshape(shape)
    vertices, faces, _, _ = marching_cubes(
        numpy.nan_to_num(field, nan=truncation), 0.0, mask=numpy.isfinite(field), gradient_direction="ascent")
    write_ply(WORK / "cubes.ply", vertices * voxel + low, numpy.ones(len(vertices)), faces[:, ::-1])
    for name in ("bracket", "cubes"):
        run("inspect", WORK / f"{name}.ply", "--show", "shape", "--picture", WORK / f"{name}.png")
        picture = Image.open(WORK / f"{name}.png")
        width, height = picture.size
        box = (width * 0.30, height * 0.12, width * 0.62, height * 0.44)
        picture.crop(tuple(map(int, box))).resize((1000, 833), Image.LANCZOS).save(WORK / f"{name}-edge.png")
    side_by_side(
        IMAGES / "surface-edge.png",
        [(WORK / "bracket-edge.png", "Frangia, voxels of 0.5 mm"), (WORK / "cubes-edge.png", "a plain field and marching cubes, 0.5 mm")],
    )


IMAGES.mkdir(parents=True, exist_ok=True)
registration()
sigma_and_closing()
block_edge()
