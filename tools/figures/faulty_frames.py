"""Frames of one view with a fault of the projector, the lamp, the camera or the part.

The rays are those of distance_renderer.py. A pattern is shown by its pixels: drive levels of 8 bits, their response, the
blur of the lens; each camera pixel is the mean of the light at its rays. So nothing here knows a formula of the program.
"""
import functools
import re

import cv2
import numpy as np

import distance_renderer as renderer
import surfaces

FIELD = 1280
AROUND = 64  # columns on each side of the field, for the blur
FINE = 8  # samples of the shown light per column
NOISE = {"gain_e_per_count": 78.43, "read_e": 8.0}
FULL = 190.0  # counts of a white surface that faces the projector
MOVED_MM = {"moved": [0.5, 0.3, 0.0], "moved a little": [0.2, 0.1, 0.0]}


def printed(p):
    return 0.65 + 0.2 * np.sin(0.9 * p[:, 0] + 0.4 * p[:, 2]) + 0.1 * np.sin(1.7 * p[:, 2] - 0.6 * p[:, 1])


def relief(p):
    """A wide, softly curved wall that fills nearly the whole field."""
    waves = 2.0 * np.sin(0.11 * p[:, 0]) * np.cos(0.09 * p[:, 2]) + 1.5 * np.sin(0.05 * p[:, 0] + 0.07 * p[:, 2])
    return 0.8 * np.maximum(p[:, 1] - waves, surfaces.box(p, (-140, -6, -90), (140, 6, 160)))


# The part, its paint, its angle on the turntable, and how far it reaches.
SCENES = {
    "bust": (renderer.PARTS["bust"], printed, 30.0, renderer.RADIUS),
    "bracket": (renderer.PARTS["bracket"], renderer.white, 25.0, renderer.RADIUS),
    "relief": (relief, printed, 120.0, 190.0),
}


def small_rig():
    rig = renderer.Rig()
    rig.size, rig.focal, rig.principal = (320, 256), 900.0, np.array([160.8, 125.7])
    return rig


@functools.cache
def seen(scene, motion=None):
    """Projector columns and shading of four rays of each pixel; the part moved by `motion` on its table."""
    part, paint, angle, radius = SCENES[scene]
    offset = np.array(MOVED_MM[motion] if motion else [0.0, 0.0, 0.0])
    samples = renderer.seen(part, small_rig(), angle, (np.eye(3), offset), paint=paint, radius=radius)
    return np.array([one[0] for one in samples]), np.array([one[1] for one in samples])


def truth(scene):
    """The projector column of each pixel, NaN where its rays do not hit one lit surface."""
    columns, shading = seen(scene)
    return np.where((shading > 0).all(axis=0) & (np.ptp(columns, axis=0) < 5), columns.mean(axis=0), np.nan)


# What the projector shows: a wave of its columns, sampled FINE times per column, in one row or in some that repeat.

ROWS = 32  # of a dithered pattern
EDGE = -AROUND - 0.5  # the left edge of the first column
COLUMNS = np.arange(-AROUND, FIELD + AROUND)
PLACES = EDGE + (np.arange(len(COLUMNS) * FINE) + 0.5) / FINE


def sine(wave):
    """The levels of 8 bits of whole columns."""
    return np.repeat(np.rint(255 * wave(COLUMNS)) / 255, FINE)[None]


def binary(wave):
    """A slide of lines: its edges are where they should be, which those of pixels are not."""
    return (wave(PLACES) >= 0.5).astype(float)[None]


def dithered(wave):
    """Black and white columns by error diffusion (Floyd and Steinberg), to and fro, until the first row is forgotten."""
    levels, below = wave(COLUMNS).tolist(), [0.0] * (len(COLUMNS) + 2)
    rows = []
    for row in range(2 * ROWS):
        error, left, below = below, 0.0, [0.0] * (len(COLUMNS) + 2)
        shown = [0.0] * len(levels)
        order = range(len(levels)) if row % 2 == 0 else range(len(levels) - 1, -1, -1)
        ahead = 1 if row % 2 == 0 else -1
        for i in order:
            wanted = levels[i] + left + error[i + 1]
            shown[i] = 1.0 if wanted >= 0.5 else 0.0
            rest = wanted - shown[i]
            left = rest * 7 / 16
            below[i + 1 - ahead] += rest * 3 / 16
            below[i + 1] += rest * 5 / 16
            below[i + 1 + ahead] += rest / 16
        rows.append(shown)
    return np.repeat(np.array(rows[ROWS:]), FINE, axis=1)


def shown_light(wave, waveform=sine, gamma=1.0, blur_px=0.6):
    """The light over the field for levels from 0 to 1, with a black level of 3 %."""
    light = (0.03 + 0.97 * waveform(wave) ** gamma).astype(np.float32)
    if len(light) > 1:
        light = np.vstack([light, light, light])
    light = cv2.GaussianBlur(light, (0, 0), blur_px * FINE, sigmaY=max(blur_px, 1e-3), borderType=cv2.BORDER_REPLICATE)
    return light[ROWS : 2 * ROWS] if len(light) > 1 else light


def fringes(period_px, shift_deg):
    return lambda column: 0.5 + 0.5 * np.cos(2 * np.pi * column / period_px + np.radians(shift_deg))


def stripes(bits, stripe_px, bit, is_binary=False, is_inverted=False):
    def wave(column):
        number = np.clip(np.floor((column + 0.5) / stripe_px).astype(int), 0, 2**bits - 1)
        code = number if is_binary else number ^ (number >> 1)
        return ((code >> (bits - 1 - bit)) & 1 ^ is_inverted).astype(float)

    return wave


def at_camera(light, scene, motion=None):
    """The light that reaches the camera's pixels from the projector, 1 for a white surface that faces it."""
    columns, shading = seen(scene, motion)
    rows = [np.interp(columns[:, k], PLACES, light[2 * k % len(light)]) for k in range(columns.shape[1])]
    return (np.stack(rows, axis=1) * shading).mean(axis=0)


# Faults of a set of frames: they change the frames from the projector, in place, from frame k on. `lamps` and `gains` are
# the light of another lamp in each frame, and the gain of its exposure.


class Frames:
    def __init__(self, light, albedo):
        self.light, self.albedo = light, albedo
        self.lamps, self.gains = [0.0] * len(light), [1.0] * len(light)


def black(frames, k, generator):
    frames.light[k] = 0 * frames.light[k]


def dim(frames, k, generator):
    frames.light[k] = 0.05 * frames.light[k]


def white(frames, k, generator):
    frames.light[k] = 0 * frames.light[k] + 4


def full(frames, k, generator):
    frames.light[k] = 1.0 * frames.albedo


def repeated(frames, k, generator):
    frames.light[k] = frames.light[k - 1]


def exchanged(frames, k, generator):
    frames.light[k], frames.light[k - 1] = frames.light[k - 1], frames.light[k]


def late(frames, k, generator):
    k = min(k, len(frames.light) - 2)  # the last frame alone is a repeated one
    frames.light[k:] = frames.light[k - 1 : -1]


def lamp(frames, k, generator):
    for one in range(max(k, 2), len(frames.light)):
        frames.lamps[one] = 0.15


def flash(frames, k, generator):
    frames.lamps[k] = 0.15


def half(frames, k, generator):
    frames.gains[k] = 0.5


def weaker(frames, k, generator):
    frames.gains[k] = 0.8


def torn(frames, k, generator):
    rows = len(frames.light[k]) // 2
    frames.light[k] = np.concatenate([frames.light[k - 1][:rows], frames.light[k][rows:]])


def textures(shape, generator):
    y, x = np.mgrid[0 : shape[0], 0 : shape[1]]
    waves = [generator.uniform(0.03, 0.15, 2) @ [x.ravel(), y.ravel()] + generator.uniform(0, 6) for _ in range(3)]
    return (0.5 + sum(np.sin(one) for one in waves).reshape(shape) / 6) * generator.uniform(0.5, 1)


def something_else(frames, k, generator):
    frames.light[k] = frames.albedo * textures(frames.light[k].shape, generator)


def mean(frames, k, generator):
    frames.light[k] = sum(frames.light) / len(frames.light)


def no_fringes(frames, k, generator):
    for one in range(len(frames.light)):
        something_else(frames, one, generator)


def reversed_order(frames, k, generator):
    frames.light.reverse()


def inverted(frames, k, generator):
    frames.light[k] = 1.03 * frames.albedo - frames.light[k]


# The camera.


def noise_of(counts):
    """The standard deviation of shot and read noise, counts."""
    return np.sqrt(
        np.maximum(counts, 0) / NOISE["gain_e_per_count"] + (NOISE["read_e"] / NOISE["gain_e_per_count"]) ** 2
    )


def record(frames, generator, level=1.0, ambient=0.04, flicker=0.0, ceiling=255, levels=(0, 255)):
    """8-bit frames, their counts mapped to `levels` and cut off at `ceiling`; and those without noise, of real numbers."""
    images, clean = [], []
    for light, lit, gain in zip(frames.light, frames.lamps, frames.gains, strict=True):
        gain = gain * (1 + flicker * generator.normal())
        counts = FULL * gain * (level * light + (lit + ambient) * (0.1 + frames.albedo))
        sigma = noise_of(counts)
        counts = levels[0] + counts * (levels[1] - levels[0]) / 255
        clean.append(np.clip(counts, 0, ceiling))
        noisy = counts + sigma * generator.normal(size=counts.shape)
        images.append(np.clip(np.rint(noisy), 0, ceiling).astype(np.uint8))
    return images, np.array(clean)


def fringe_design(shifts_deg):
    shifts = np.radians(shifts_deg)
    return np.stack([np.ones(len(shifts)), np.cos(shifts), -np.sin(shifts)], axis=1)


def fitted(frames, shifts_deg):
    """Phase and residual of the least squares fit of a fringe at each pixel."""
    design = fringe_design(shifts_deg)
    values = np.tensordot(np.linalg.pinv(design), frames, 1)
    return np.arctan2(values[2], values[1]), frames - np.tensordot(design, values, 1)


def write(folder, patterns, images, white_level=255, states_noise=True):
    """The scan folder of one view; `patterns` are tables of scan.toml, `images` the frames by name of the pattern."""
    view = folder / "views" / "000"
    view.mkdir(parents=True)
    lines = ['format = "frangia-scan"', "version = 2"]
    for pattern in patterns:
        lines += ["[[pattern]]", *(f"{key} = {quoted(value)}" for key, value in pattern.items())]
        for k, image in enumerate(images[pattern["name"]]):
            cv2.imwrite(str(view / f"{pattern['name']}-{k}.png"), image, [cv2.IMWRITE_PNG_COMPRESSION, 1])
    (folder / "scan.toml").write_text("\n".join([*lines, "[[view]]", 'folder = "views/000"', ""]))
    noise = "\n".join(["[camera.noise]", *(f"{key} = {value}" for key, value in NOISE.items())])
    rig = re.sub(r"white_level = \d+", f"white_level = {white_level}", small_rig().toml())
    (folder / "rig.toml").write_text(rig.replace("[projector]", noise + "\n[projector]") if states_noise else rig)


def quoted(value):
    return f'"{value}"' if isinstance(value, str) else str(value)
