"""Captures of a board by a simulated rig of half size, rendered once without noise; noise and faults are added to copies."""
import pathlib
import shutil
import tomllib

import cv2
import numpy

FULL_WELL_E, READ_E = 20000.0, 8.0  # as frangia simulate has them

HALF_RIG = """format = "frangia-rig"
version = 1

[camera]
size_px = [640, 512]
focal_px = [1200, 1200]
principal_point_px = [326.8, 251.4]
distortion = [-0.09, 0.05, 0.0004, -0.0003, 0]
white_level = 255

[projector]
model = "pinhole"
position_mm = [-180, -20, 30]
rotation = [[0.931242779706, 0, -0.364399348581], [-0.0147420196862, 0.999181334288, -0.0376740503092], [0.364101027328, 0.0404556697031, 0.930480403172]]
size_px = [912, 570]
focal_px = [1353, 1353]
principal_point_px = [455.5, 284.5]

[turntable]
point_mm = [3.5, 50, 516]
axis = [-0.009387553932644826, -0.882947592858927, -0.46937769663224127]
"""


def rendered(study, kind, poses, *options):
    """Poses of a board without noise in 16 bits."""
    rig = study.work / "half-rig.toml"
    rig.write_text(HALF_RIG)
    return study.simulated("--calibration", kind, "--views", poses, "--rig", rig, "--no-noise", "--bits", 16, *options)


class Capture:
    """The frames of a rendered scan in memory, as a share of white."""

    def __init__(self, scan):
        self.scan = scan
        self.frames = {
            path.relative_to(scan): cv2.imread(str(path), cv2.IMREAD_UNCHANGED).astype(numpy.float32) / 65535
            for path in sorted(scan.glob("views/*/*.png"))
        }
        self.text = {name: (scan / name).read_text() for name in ("scan.toml", "rig.toml")}
        self.text["rig.toml"] = self.text["rig.toml"].replace("white_level = 65535", "white_level = 255")
        self.truth = tomllib.loads((scan / "truth-rig.toml").read_text())
        self.noise = numpy.random.default_rng(1).standard_normal(1 << 22, numpy.float32)

    def write(self, folder, seed, change=None, text=None):
        """Writes the scan with shot and read noise in 8 bits.

        `change` maps a dictionary of frames, `text` that of the two text files, before noise is added.
        """
        frames = change(dict(self.frames)) if change else self.frames
        shutil.rmtree(folder, ignore_errors=True)
        random = numpy.random.default_rng(seed)
        for path, frame in frames.items():
            start = int(random.integers(0, self.noise.size - frame.size))
            noise = self.noise[start : start + frame.size].reshape(frame.shape)
            electrons = numpy.maximum(frame, 0) * FULL_WELL_E
            electrons += numpy.sqrt(electrons + READ_E**2) * noise
            image = numpy.clip(numpy.rint(electrons * (255 / FULL_WELL_E)), 0, 255).astype(numpy.uint8)
            (folder / path).parent.mkdir(parents=True, exist_ok=True)
            cv2.imwrite(str(folder / path), image, [cv2.IMWRITE_PNG_COMPRESSION, 0])
        for name, content in (text(dict(self.text)) if text else self.text).items():
            (folder / name).write_text(content)
        return pathlib.Path(folder)
