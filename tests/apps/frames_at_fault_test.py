"""Frames at fault are named, and what they spoil is not measured: frames_at_fault_test.py PROGRAM.

A ball before a wall is rendered by ray tracing in NumPy with two pinholes, 2 x 2 rays a pixel; the truth is the ball and the
wall. Nothing of the program makes the frames.
"""
import json
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

import numpy as np

PROGRAM = pathlib.Path(sys.argv[1]).resolve()
WIDTH, HEIGHT, FOCAL = 200, 160, 350.0
PROJECTOR_WIDTH, PROJECTOR_HEIGHT, PROJECTOR_FOCAL = 1280, 720, 2000.0
POSITION = np.array([-150.0, 0.0, 0.0])
TURN = np.arctan2(150.0, 520.0)
ROTATION = np.array([[np.cos(TURN), 0, -np.sin(TURN)], [0, 1, 0], [np.sin(TURN), 0, np.cos(TURN)]])
BALL, RADIUS, WALL = np.array([5.0, -4.0, 500.0]), 45.0, 560.0


def hit(origin, rays):
    """The distance along each ray at which it meets the ball or the wall, in lengths of the ray."""
    from_ball = origin - BALL
    b = (rays * from_ball).sum(-1)
    c = (from_ball * from_ball).sum(-1) - RADIUS**2
    a = (rays * rays).sum(-1)
    root = b * b - a * c
    ball = np.where(root > 0, (-b - np.sqrt(np.maximum(root, 0))) / a, np.inf)
    ball = np.where(ball > 1e-6, ball, np.inf)
    return np.minimum(ball, (WALL - origin[..., 2]) / rays[..., 2])


def trace():
    """Projector column and shade (0 where unlit) of 2 x 2 rays a pixel."""
    samples = []
    for dy in (-0.25, 0.25):
        for dx in (-0.25, 0.25):
            x, y = np.meshgrid(np.arange(WIDTH) + dx, np.arange(HEIGHT) + dy)
            rays = np.stack([(x - (WIDTH - 1) / 2) / FOCAL, (y - (HEIGHT - 1) / 2) / FOCAL, np.ones_like(x)], -1)
            point = rays * hit(np.zeros(3), rays)[..., None]
            on_ball = np.linalg.norm(point - BALL, axis=-1) < RADIUS + 1e-3
            normal = np.where(on_ball[..., None], (point - BALL) / RADIUS, np.array([0, 0, -1.0]))
            to_light = POSITION - point
            direction = to_light / np.linalg.norm(to_light, axis=-1)[..., None]
            lit = hit(np.broadcast_to(POSITION, point.shape), -to_light) > 1 - 1e-6
            seen = (point - POSITION) @ ROTATION.T
            column = PROJECTOR_FOCAL * seen[..., 0] / seen[..., 2] + (PROJECTOR_WIDTH - 1) / 2
            lit &= (column > -0.5) & (column < PROJECTOR_WIDTH - 0.5)
            samples.append((column, 0.9 * np.maximum((normal * direction).sum(-1), 0) * lit))
    return samples


SAMPLES = trace()


def frame(light, seed, gain=200.0):
    """What the camera records, counts: `light` gives the projector's light, 0 to 1, at a column."""
    counts = 6.0 + gain * sum(shade * light(column) for column, shade in SAMPLES) / len(SAMPLES)
    noise = np.random.default_rng(seed).standard_normal(counts.shape)
    return counts + 0.8 * np.sqrt(0.3 + counts / 255) * noise


def fringe(period, shift_deg):
    return lambda column: 0.5 + 0.5 * np.cos(2 * np.pi * column / period + np.deg2rad(shift_deg))


def gray(bit, bits, stripe):
    def light(column):
        stripes = np.floor((np.round(column) + 0.5) / stripe).astype(int)
        return ((stripes ^ (stripes >> 1)) >> (bits - 1 - bit) & 1).astype(float)

    return light


def write_png(path, image):
    depth = image.dtype.itemsize * 8
    rows = b"".join(b"\0" + row.astype(">u2" if depth == 16 else "u1").tobytes() for row in image)

    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    header = struct.pack(">IIBBBBB", image.shape[1], image.shape[0], depth, 0, 0, 0, 0)
    path.write_bytes(
        b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 1)) + chunk(b"IEND", b"")
    )


def to_8_bits(counts, ceiling=255):
    return np.clip(np.round(counts), 0, ceiling).astype(np.uint8)


def points_of(path):
    """The vertices of a binary PLY, with their sigma."""
    data = path.read_bytes()
    header, body = data.split(b"end_header\n", 1)
    kinds = {b"ushort": "<u2", b"float": "<f4", b"double": "<f8", b"uchar": "u1", b"int": "<i4", b"uint": "<u4"}
    fields, count, inside = [], 0, False
    for line in header.split(b"\n"):
        words = line.split()
        if words[:1] == [b"element"]:
            inside = words[1] == b"vertex"
            count = int(words[2]) if inside else count
        elif words[:1] == [b"property"] and inside:
            fields.append((words[2].decode(), kinds[words[1]]))
    table = np.frombuffer(body, np.dtype(fields), count)
    return np.stack([table["x"], table["y"], table["z"]], -1).astype(float), table["sigma_mm"].astype(float)


def error_of(points):
    """Standard deviation of the distance of points from the ball or the wall, by the median, mm; at most 2 % are far."""
    ball = np.abs(np.linalg.norm(points - BALL, axis=1) - RADIUS)
    errors = np.minimum(ball, np.abs(points[:, 2] - WALL))
    assert (errors > 0.5).mean() < 0.02, f"{(errors > 0.5).mean():.1%} of the points are more than 0.5 mm wrong"
    return float(np.median(errors) / 0.6745)


class Scan:
    """A scan folder of one or several views with patterns of fringes and a Gray code."""

    def __init__(self, folder, steps, coarse=False, views=1, white_level=255, bits_of_code=5):
        self.folder, self.steps, self.views = folder, steps, views
        self.fringes = {"f": 80, **({"c": 1280} if coarse else {})}
        self.code = 0 if coarse else bits_of_code
        shifts = [360 / steps * k for k in range(steps)]
        text = 'format = "frangia-scan"\nversion = 2\n'
        for name, period in self.fringes.items():
            text += f'[[pattern]]\nname = "{name}"\nkind = "fringe"\nperiod_px = {period}\nshifts_deg = {shifts}\n'
        if self.code:
            text += f'[[pattern]]\nname = "g"\nkind = "gray"\nbits = {self.code}\nstripe_px = 40\n'
        for view in range(views):
            text += f'[[view]]\nfolder = "views/{view:03}"\n'
        folder.mkdir(parents=True)
        (folder / "scan.toml").write_text(text)
        (folder / "rig.toml").write_text(
            f'format = "frangia-rig"\nversion = 1\n[camera]\nsize_px = [{WIDTH}, {HEIGHT}]\nfocal_px = [{FOCAL}, {FOCAL}]\n'
            f"principal_point_px = [{(WIDTH - 1) / 2}, {(HEIGHT - 1) / 2}]\n"
            + (f"white_level = {white_level}\n" if white_level else "")
            + f'[projector]\nmodel = "pinhole"\nsize_px = [{PROJECTOR_WIDTH}, {PROJECTOR_HEIGHT}]\n'
            f"focal_px = [{PROJECTOR_FOCAL}, {PROJECTOR_FOCAL}]\n"
            f"principal_point_px = [{(PROJECTOR_WIDTH - 1) / 2}, {(PROJECTOR_HEIGHT - 1) / 2}]\n"
            f"position_mm = {POSITION.tolist()}\nrotation = {ROTATION.tolist()}\n"
        )

    def capture(self, change=None, to_image=to_8_bits, gain=200.0):
        """Writes all frames; `change(view, pattern, frames)` returns those that the camera delivers."""
        for view in range(self.views):
            out = self.folder / f"views/{view:03}"
            out.mkdir(parents=True)
            for number, (name, period) in enumerate(self.fringes.items()):
                frames = [
                    frame(fringe(period, 360 / self.steps * k), 1000 * view + 100 * number + k, gain)
                    for k in range(self.steps)
                ]
                for k, counts in enumerate(change(view, name, frames) if change else frames):
                    write_png(out / f"{name}-{k}.png", to_image(counts))
            for bit in range(self.code):
                write_png(
                    out / f"g-{bit}.png", to_image(frame(gray(bit, self.code, 40), 1000 * view + 900 + bit, gain))
                )
        return self

    def reconstruct(self, *options):
        mesh = self.folder / "mesh.ply"
        done = subprocess.run(
            [PROGRAM, "--json", "reconstruct", self.folder, "-o", mesh, *options], capture_output=True, text=True
        )
        text = done.stdout or done.stderr
        answer = json.loads(text[text.index("{") :]) if "{" in text else {}
        if done.returncode not in (0, 4):
            return done.returncode, answer, text + done.stderr, None, None
        points, sigma = points_of(mesh)
        return done.returncode, answer, text + done.stderr, error_of(points), float(np.median(sigma))


def black(which):
    return lambda view, name, frames: [
        frame(lambda column: 0 * column, 7000 + k) if name == "f" and k == which else counts
        for k, counts in enumerate(frames)
    ]


def repeated(which, views=(0,)):
    def change(view, name, frames):
        if name != "f" or view not in views:
            return frames
        return [frames[k - 1] if k == which else counts for k, counts in enumerate(frames)]

    return change


class FramesAtFault(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.scans = 0

    def scan(self, *arguments, **options):
        self.scans += 1
        return Scan(pathlib.Path(self.folder.name) / f"scan{self.scans}", *arguments, **options)

    def test_a_black_frame_is_named_and_left_out(self):
        for steps, coarse in ((6, False), (5, False), (6, True)):
            with self.subTest(steps=steps, coarse=coarse):
                code, _, text, error, sigma = self.scan(steps, coarse=coarse).capture(black(2)).reconstruct()
                self.assertEqual(code, 0, text)
                self.assertIn('pattern \\"f\\": frame 2 is black', text)
                self.assertLess(error, 1.8 * sigma)

    def test_three_frames_with_a_black_one_measure_nothing(self):
        code, _, text, _, _ = self.scan(3).capture(black(1)).reconstruct()
        self.assertEqual(code, 5, text)
        self.assertIn("frame 1 is black", text)

    def test_a_repeated_frame_is_named_and_left_out(self):
        code, _, text, error, sigma = self.scan(12).capture(repeated(6)).reconstruct()
        self.assertEqual(code, 0, text)
        self.assertIn("frame 6 repeats frame 5", text)
        self.assertLess(error, 1.8 * sigma)

    def test_clipping_below_the_white_level_is_found(self):
        for name, to_image, white_level in (
            ("240", lambda counts: to_8_bits(counts, 240), 0),
            ("235", lambda counts: to_8_bits(np.maximum(16 + counts * 219 / 255, 16), 235), 255),
            ("255", lambda counts: to_8_bits(counts).astype(np.uint16), 1023),
        ):
            with self.subTest(name):
                scan = self.scan(4, coarse=True, white_level=white_level).capture(to_image=to_image, gain=330.0)
                code, _, text, error, sigma = scan.reconstruct()
                self.assertEqual(code, 0, text)
                self.assertIn(f"cut off at {name} counts", text)
                self.assertLess(error, 1.8 * sigma)

    def test_a_dark_end_that_the_camera_cuts_off_is_found(self):
        for steps, level in ((4, 0), (3, 0), (6, 16)):
            with self.subTest(steps=steps, level=level):
                cut = lambda counts: to_8_bits(np.maximum(counts - 24 + level, level))  # noqa: E731
                code, _, text, error, sigma = self.scan(steps, coarse=True).capture(to_image=cut).reconstruct()
                self.assertEqual(code, 0, text)
                self.assertIn(f"cuts the dark end of the fringes off at {level} counts", text)
                self.assertLess(error, 1.8 * sigma)

    def test_frames_that_are_no_fringes_are_refused(self):
        x, y = np.meshgrid(np.arange(WIDTH), np.arange(HEIGHT))

        def photographs(view, name, frames):
            return [
                30 + 90 * (1 + np.sin(0.05 * (k + 1) * x + k) * np.cos(0.06 * y * (6 - k))) for k in range(len(frames))
            ]

        code, _, text, _, _ = self.scan(5).capture(photographs).reconstruct()
        self.assertEqual(code, 5, text)
        self.assertIn("show no fringes with its shifts", text)

    def test_four_frames_that_are_no_fringes_are_refused(self):
        x, y = np.meshgrid(np.arange(WIDTH), np.arange(HEIGHT))
        for seed in range(4):
            draw = np.random.default_rng(seed)

            def photographs(view, name, frames):
                out = []
                for _ in frames:
                    waves = [draw.uniform(0.03, 0.15, 2) @ [x.ravel(), y.ravel()] + draw.uniform(0, 6) for _ in "abc"]
                    light = 0.5 + sum(map(np.sin, waves)).reshape(x.shape) / 6
                    out.append(190 * light * draw.uniform(0.5, 1) + draw.standard_normal(x.shape))
                return out

            with self.subTest(seed):
                code, _, text, _, _ = self.scan(4).capture(photographs).reconstruct()
                self.assertEqual(code, 5, text)

    def test_a_frame_of_three_is_named_by_coarser_patterns(self):
        def half(view, name, frames):
            return [counts * (0.5 if name == "f" and k == 1 else 1) for k, counts in enumerate(frames)]

        code, _, text, _, _ = self.scan(3, coarse=True).capture(half).reconstruct()
        self.assertEqual(code, 5, text)
        self.assertIn("frame 1 has 0.50 times the light", text)

    def test_columns_outside_the_projector_are_not_measured(self):
        scan = self.scan(4).capture()
        rig = scan.folder / "rig.toml"
        rig.write_text(
            rig.read_text().replace(f"size_px = [{PROJECTOR_WIDTH}, ", f"size_px = [{PROJECTOR_WIDTH // 2}, ")
        )
        code, _, text, _, _ = scan.reconstruct()
        self.assertEqual((code, "names columns outside the projector" in text), (0, True), text)
        inside = (np.concatenate([c[shade > 0] for c, shade in SAMPLES]) < PROJECTOR_WIDTH // 2).mean()
        self.assertLess(len(points_of(scan.folder / "mesh.ply")[0]), 1.05 * inside * WIDTH * HEIGHT)
        rig.write_text(rig.read_text().replace(f"size_px = [{PROJECTOR_WIDTH // 2}, ", "size_px = [300, "))
        self.assertEqual(scan.reconstruct()[0], 5)  # most are outside, and the others right by chance

    def test_simulated_faults_are_explained(self):
        folder = pathlib.Path(self.folder.name) / "simulated"
        faults = ("--lose-frame", "0:p160:2", "--repeat-frame", "0:p20:3", "--shifts", "6", "--views", "1")
        subprocess.run([PROGRAM, "--quiet", "simulate", "plate", *faults, "-o", folder], check=True)
        view = folder / "views/000"
        self.assertEqual((view / "p20-3.png").read_bytes(), (view / "p20-2.png").read_bytes())
        done = subprocess.run(
            [PROGRAM, "--json", "decode", folder, "-o", folder / "maps"], capture_output=True, text=True, check=True
        )
        answer = json.loads(done.stdout)
        found = {one["pattern"]: (one["cause"], one["left_out"]) for one in answer["explanations"]}
        self.assertEqual(found, {"p1280": ("as-described", []), "p160": ("lost", [2]), "p20": ("repeated", [3])})

    def test_sound_frames_are_not_blamed(self):
        for steps, coarse in ((3, False), (4, True), (6, False)):
            with self.subTest(steps=steps):
                code, answer, text, error, sigma = self.scan(steps, coarse=coarse).capture().reconstruct()
                self.assertEqual(code, 0, text)
                self.assertEqual(answer["warnings"], [])
                self.assertLess(error, 1.8 * sigma)

    def test_a_view_without_enough_frames_is_left_out_and_named(self):
        scan = self.scan(4, views=3).capture(repeated(2, views=(1,)))
        code, answer, text, error, sigma = scan.reconstruct("--no-register")
        self.assertEqual(code, 4, text)
        self.assertIn('views/001: pattern \\"f\\": ', text)
        self.assertIn("frame 2 repeats frame 1", text)
        self.assertEqual([view["left_out"] for view in answer["per_view"]], [False, True, False])
        self.assertIn("frame 2 repeats frame 1", answer["per_view"][1]["reason"])
        self.assertLess(error, 1.8 * sigma)

    def test_a_view_without_a_point_is_left_out_and_named(self):
        def dark(views):
            return lambda view, name, frames: [0 * counts + 5 for counts in frames] if view in views else frames

        code, answer, text, error, sigma = (
            self.scan(4, views=2, coarse=True).capture(dark({1})).reconstruct("--no-register")
        )
        self.assertEqual(code, 4, text)
        self.assertEqual([view["left_out"] for view in answer["per_view"]], [False, True])
        self.assertIn("no point was measured", answer["per_view"][1]["reason"])
        self.assertLess(error, 1.8 * sigma)
        code, _, text, _, _ = self.scan(4, views=2, coarse=True).capture(dark({0, 1})).reconstruct("--no-register")
        self.assertEqual(code, 5, text)

    def test_a_lost_frame_of_the_coarsest_pattern_is_named(self):
        def lost(view, name, frames):
            return [0 * counts + 5 if name == "c" and k == 2 else counts for k, counts in enumerate(frames)]

        code, _, text, error, sigma = self.scan(6, coarse=True).capture(lost).reconstruct()
        self.assertEqual(code, 0, text)
        self.assertIn('pattern \\"c\\": frame 2 is black', text)
        self.assertLess(error, 1.8 * sigma)

    def test_a_lost_frame_of_a_gray_code_is_named(self):
        scan = self.scan(4).capture()
        write_png(scan.folder / "views/000/g-3.png", np.full((HEIGHT, WIDTH), 6, np.uint8))
        code, _, text, _, _ = scan.reconstruct()
        self.assertEqual(code, 5, text)
        self.assertIn("frame 3 shows no stripes", text)

    def test_a_simulated_lamp_is_named(self):
        folder = pathlib.Path(self.folder.name) / "lamp"
        options = ("--lamp-on", "0:9", "--shifts", "6", "--views", "1", "--periods", "1280,40")
        subprocess.run([PROGRAM, "--quiet", "simulate", "plate", *options, "-o", folder], check=True)
        done = subprocess.run(
            [PROGRAM, "--json", "decode", folder, "-o", folder / "maps"], capture_output=True, text=True
        )
        found = {one["pattern"]: (one["cause"], one["frames"]) for one in json.loads(done.stdout)["explanations"]}
        self.assertEqual(found, {"p1280": ("as-described", []), "p40": ("lamp", [3])})

    def expect_remedied(self, scan, cause):
        """The cause is named and the remedy offered; with it the part is measured."""
        code, _, text, _, _ = scan.reconstruct()
        self.assertEqual(code, 5, text)
        self.assertIn(cause, text)
        self.assertIn("--accept-remedy", text)
        code, _, text, error, sigma = scan.reconstruct("--accept-remedy")
        self.assertEqual(code, 0, text)
        self.assertLess(error, 2.2 * sigma)

    def test_frames_that_are_late_are_used_if_the_remedy_is_accepted(self):
        def late(view, name, frames):
            return frames[:5] + frames[4:-1] if name == "f" else frames

        self.expect_remedied(self.scan(12).capture(late), "the frames from 5 on are late by one")

    def test_frames_that_are_late_all_through_are_named_and_can_be_used(self):
        # The fine pattern comes first, then the coarse one, whose last frame is missing.
        for steps in (4, 6):
            last = frame(lambda column: 0 * column, 7000)

            def late(view, name, frames):
                nonlocal last
                shown = [last, *frames[:-1]]
                last = frames[-1]
                return shown

            scan = self.scan(steps, coarse=True).capture(late)
            self.expect_remedied(scan, "all frames are late by one frame")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
