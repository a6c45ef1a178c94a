"""Frames of any sequence of fringes and stripes, from parts that are rendered once and from walls."""

import json
import math
import re
import shutil

import cv2
import numpy as np

GAIN_E, READ_E = 78.43, 8.0  # the camera noise of the sample scans: electrons per count, electrons
FIELD = 1280


def toml_of(patterns):
    """scan.toml of one view."""
    lines = ['format = "frangia-scan"', "version = 2"]
    for pattern in patterns:
        lines.append("[[pattern]]")
        lines += [f"{key} = {json.dumps(value)}" for key, value in pattern["keys"].items()]
    return "\n".join(lines + ["[[view]]", 'folder = "views/000"', ""])


def small_rig(study):
    """The digital rig with a camera of 320 x 256 pixels."""
    text = (study.simulated("plate", "--views", 1, "--samples", 1) / "rig.toml").read_text()
    camera, rest = text.split("[camera.noise]")

    def numbers(values):
        return [float(value) for value in values.split(",")]

    camera = re.sub(r"size_px = \[(.*?)\]", "size_px = [320, 256]", camera)
    camera = re.sub(r"focal_px = \[(.*?)\]", lambda m: f"focal_px = {[v / 3 for v in numbers(m[1])]}", camera)
    camera = re.sub(
        r"principal_point_px = \[(.*?)\]",
        lambda m: f"principal_point_px = {[(v + 0.5) / 3 - 0.5 for v in numbers(m[1])]}",
        camera,
    )
    path = study.work / "small-rig.toml"
    path.write_text(camera + "[camera.noise]" + rest)
    return path


class Scene:
    """A part, rendered once without noise: the mean, the modulation and the projector column at each pixel.

    Frames of any sequence follow from them by the model I = A + B cos(2 pi u / period + shift).
    """

    def __init__(self, study, rig, part):
        folder = study.simulated(
            part, "--rig", rig, "--views", 1, "--samples", 1, "--no-noise", "--bits", 16, "--periods", FIELD, 160, 20
        )

        def frame(name):
            return cv2.imread(str(folder / "views" / "000" / f"{name}.png"), cv2.IMREAD_UNCHANGED).astype(float) / 257

        column = None
        for period in (FIELD, 160, 20):
            i = [frame(f"p{period}-{k}") for k in range(4)]
            phase = np.arctan2(i[3] - i[1], i[0] - i[2])
            if column is None:
                column = np.mod(phase, 2 * math.pi) / (2 * math.pi) * period
            column = column + period * (np.mod(phase / (2 * math.pi) - column / period + 0.5, 1) - 0.5)
        self.mean = sum(i) / 4
        self.modulation = np.hypot(i[3] - i[1], i[0] - i[2]) / 2
        self.column = column

    def fringe(self, period, shift_deg):
        return self.mean + self.modulation * np.cos(2 * math.pi * self.column / period + math.radians(shift_deg))

    def stripes(self, bits, stripe, bit, binary=False, inverse=False):
        number = np.floor((self.column + 0.5) / stripe).astype(int)
        code = number if binary else number ^ (number >> 1)
        bright = (code >> (bits - 1 - bit)) & 1
        return self.mean + self.modulation * np.where((bright == 1) != inverse, 1, -1)


def wall(generator):
    """A bumpy wall that fills nearly the whole field, so that the borders of the widest stripes are seen."""
    scene = Scene.__new__(Scene)
    y, x = np.mgrid[0:256, 0:320]
    bumps = sum(
        generator.uniform(5, 15) * np.sin(x * generator.uniform(0.01, 0.04) + y * generator.uniform(0.01, 0.04))
        for _ in range(3)
    )
    scene.column = 20 + 1240 * x / 319 + bumps
    scene.modulation = 60 + 20 * np.sin(0.02 * y)
    scene.mean = 1.2 * scene.modulation + 20
    return scene


def fringes(counts, steps=4):
    """Declared patterns and what is really shown: the same."""
    shifts = [360 * k / steps for k in range(steps)]
    return [
        {
            "keys": {"name": f"f{count}", "kind": "fringe", "period_px": FIELD / count, "shifts_deg": list(shifts)},
            "shown": {"period": FIELD / count, "shifts": list(shifts)},
        }
        for count in counts
    ]


def gray():
    """Fringes of 40 px with a Gray code of 20 px stripes."""
    code = {
        "keys": {"name": "gray", "kind": "gray", "bits": 6, "stripe_px": 20},
        "shown": {"frames": [(bit, False, False) for bit in range(6)]},
    }
    return fringes([32]) + [code]


def write_scan(folder, scene, patterns, rig, generator):
    shutil.rmtree(folder, ignore_errors=True)
    (folder / "views" / "000").mkdir(parents=True)
    shutil.copy(rig, folder / "rig.toml")
    (folder / "scan.toml").write_text(toml_of(patterns))
    for pattern in patterns:
        shown = pattern["shown"]
        if "shifts" in shown:
            clean = [scene.fringe(shown["period"], shift) for shift in shown["shifts"]]
        else:
            clean = [
                scene.mean - scene.modulation if one is None else scene.stripes(6, 20, one[0], one[1], one[2])
                for one in shown["frames"]
            ]
        for k, image in enumerate(clean):
            sigma = np.sqrt(np.maximum(image, 0) / GAIN_E + (READ_E / GAIN_E) ** 2)
            noisy = np.clip(np.rint(image + sigma * generator.normal(size=image.shape)), 0, 255).astype(np.uint8)
            cv2.imwrite(
                str(folder / "views" / "000" / f"{pattern['keys']['name']}-{k}.png"),
                noisy,
                [cv2.IMWRITE_PNG_COMPRESSION, 1],
            )
