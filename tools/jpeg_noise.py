#!/usr/bin/env python3
"""Measures the noise that JPEG adds to fringe frames, for jpeg_noise_counts2.

    tools/jpeg_noise.py PROGRAM FOLDER

Simulates scans with and without noise, compresses the noisy frames at several qualities with libjpeg (by OpenCV), and
compares the wrapped phase with that of the frames without noise. The error of the phase, as the variance of a frame,
is split into what the program estimates from the frames (second differences along the rows of what four steps
overdetermine) and the rest, which the quality has to explain. It prints that rest, the rule, and the ratio of the two.
"""
import subprocess
import sys
from pathlib import Path

import cv2
import numpy as np

QUALITIES = (100, 98, 95, 92, 90, 85, 80, 75, 70, 60, 50, 30)
PERIODS = (40, 20, 10)
STEPS = 4


def rule(quality):
    """jpeg_noise_counts2 of src/frangia/frames/jpeg_noise.cpp."""
    scale = (200 - 2 * quality) / 100 if quality >= 50 else 50 / quality
    return 0.05 + 12.0 * scale**1.5


def frames(folder, period):
    return [cv2.imread(str(folder / "views/000" / f"p{period}-{k}.png"), cv2.IMREAD_UNCHANGED) for k in range(STEPS)]


def wrapped(images):
    shifts = 2 * np.pi * np.arange(STEPS) / STEPS
    stack = np.array(images, float)
    sine = np.tensordot(np.sin(shifts), stack, 1)
    cosine = np.tensordot(np.cos(shifts), stack, 1)
    return np.arctan2(-sine, cosine), 2 / STEPS * np.hypot(sine, cosine)


def compressed(image, quality):
    return cv2.imdecode(cv2.imencode(".jpg", image, [cv2.IMWRITE_JPEG_QUALITY, quality])[1], cv2.IMREAD_UNCHANGED)


def estimated(images, mask):
    """Noise variance as NoiseSamples estimates it."""
    stack = np.array(images, float)
    residual = (stack[0] - stack[1] + stack[2] - stack[3]) / 2
    second = np.abs(residual[:, :-2] - 2 * residual[:, 1:-1] + residual[:, 2:])[mask[:, 1:-1]] / np.sqrt(6)
    sigma = max(np.median(second) / 0.6745, 0.3)
    for _ in range(3):
        sigma = np.sqrt(np.mean(second[second <= 3 * sigma] ** 2) / 0.9733)
    return max(sigma**2, 1 / 12)


def main():
    program, folder = sys.argv[1], Path(sys.argv[2])
    print("part      period  " + "  ".join(f"q{q:<9}" for q in QUALITIES))
    for part in ("ball-bar", "bust", "plate"):
        scans = {}
        for name, options in {"noisy": [], "clean": ["--no-noise", "--bits", "16"]}.items():
            scans[name] = folder / f"{part}-{name}"
            if not scans[name].exists():
                subprocess.run(
                    [
                        program,
                        "--quiet",
                        "simulate",
                        part,
                        "--views",
                        "1",
                        "--periods",
                        ",".join(map(str, (1280, 160, *PERIODS))),
                        "-o",
                        scans[name],
                        *options,
                    ],
                    check=True,
                )
        for period in PERIODS:
            truth, modulation = wrapped(frames(scans["clean"], period))
            modulation = modulation / 257  # of 8 bits
            noisy = frames(scans["noisy"], period)
            good = (modulation > 20) & np.all([image < 250 for image in noisy], axis=0)
            good = cv2.erode(good.astype(np.uint8), np.ones((9, 9))) > 0
            cells = []
            for quality in QUALITIES:
                images = [compressed(image, quality) for image in noisy]
                error = np.angle(np.exp(1j * (wrapped(images)[0] - truth)))[good]
                total = np.mean(error**2 * STEPS * modulation[good] ** 2 / 2)
                rest = total - estimated(images, good)
                ratio = np.sqrt(total / (estimated(images, good) + rule(quality)))
                cells.append(f"{rest:5.2f} ({ratio:4.2f})")
            print(f"{part:<9} {period:>6}  " + "  ".join(cells))
    print("rule              " + "  ".join(f"{rule(q):5.2f}      " for q in QUALITIES))
    print("In brackets: error over sigma with the rule.")


if __name__ == "__main__":
    main()
