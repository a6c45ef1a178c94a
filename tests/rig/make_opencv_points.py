#!/usr/bin/env python3
"""Prints the table of tests/rig/camera_model_test.cpp from OpenCV. Debian: python3-opencv.

usage: make_opencv_points.py
"""

import cv2
import numpy as np

MATRIX = np.array([[1200.0, 0.0, 326.8], [0.0, 1190.0, 251.4], [0.0, 0.0, 1.0]])
MODELS = {  # k1 k2 p1 p2 k3 k4 k5 k6 s1 s2 s3 s4 tau_x tau_y
    "mild": [-0.09, 0.05, 4e-4, -3e-4, 0.01],
    "wide": [-0.31, 0.12, -2e-3, 1.5e-3, -0.02],
    "rational": [0.21, -0.12, 4e-4, -3e-4, 0.03, 0.33, -0.06, 0.02],
    "prism": [-0.12, 0.05, 4e-4, -3e-4, 0.01, 0.02, -0.01, 0.003, 1e-3, -2e-4, 5e-4, 1e-4],
    "tilted": [-0.12, 0.05, 4e-4, -3e-4, 0.01, 0.02, -0.01, 0.003, 1e-3, -2e-4, 5e-4, 1e-4, 0.03, -0.05],
}
POINTS = [(0.0, 0.0, 250.0), (30.0, -20.0, 400.0), (-85.0, 60.0, 400.0), (120.0, 95.0, 500.0), (-140.0, -110.0, 450.0)]
PIXELS = [(0.0, 0.0), (326.8, 251.4), (639.0, 511.0), (17.25, 480.5), (600.0, 30.0)]
# undistortPoints stops after five iterations by default.
CRITERIA = (cv2.TERM_CRITERIA_EPS | cv2.TERM_CRITERIA_COUNT, 1000, 1e-15)


def main():
    print(f"// OpenCV {cv2.__version__}")
    for name, coefficients in MODELS.items():
        distortion = np.array(coefficients)
        points = np.array(POINTS)
        pixels = cv2.projectPoints(points, np.zeros(3), np.zeros(3), MATRIX, distortion)[0].reshape(-1, 2)
        print(f"{name}, projectPoints: point, pixel")
        for point, pixel in zip(points, pixels):
            print("    {{%g, %g, %g}, {%.17g, %.17g}}," % (*point, *pixel))
        rays = cv2.undistortPointsIter(
            np.array(PIXELS).reshape(-1, 1, 2), MATRIX, distortion, None, None, CRITERIA
        ).reshape(-1, 2)
        print(f"{name}, undistortPoints: pixel, ray")
        for pixel, ray in zip(PIXELS, rays):
            print("    {{%g, %g}, {%.17g, %.17g}}," % (*pixel, *ray))


if __name__ == "__main__":
    main()
