#!/usr/bin/env python3
"""Writes tests/exchange/data: one rig as OpenCV, scipy (MATLAB's .mat) and json write it, and the pixels of a few points.

usage: make_calibrations.py. Debian: python3-opencv, python3-scipy.

Every file holds the same camera and projector in the convention of its program. OpenCV itself projects the points, so that
neither the conversion nor the camera model of Frangia takes part in the truth, points.json.
"""
import json
import pathlib

import cv2
import numpy as np
import scipy.io

DATA = pathlib.Path(__file__).parent / "data"
CAMERA = np.array([[1500.25, 0.0, 633.5], [0.0, 1498.75, 521.25], [0.0, 0.0, 1.0]])
CAMERA_D = np.array([-0.11, 0.07, 4e-4, -3e-4, 0.012])
PROJECTOR = np.array([[2100.5, 0.0, 640.75], [0.0, 2098.0, 790.5], [0.0, 0.0, 1.0]])
PROJECTOR_D = np.array([-0.05, 0.02, -2e-4, 1e-4, 0.003])
ROTATION = cv2.Rodrigues(np.array([0.08, -0.31, 0.05]))[0]
TRANSLATION = np.array([[-152.5], [11.25], [43.0]])
SIZE, PROJECTOR_SIZE = (1280, 1024), (1280, 800)
POINTS = np.array([[0.0, 0.0, 480.0], [60.0, -45.0, 500.0], [-80.0, 70.0, 430.0], [110.0, 85.0, 560.0]])


def storage(name, values):
    file = cv2.FileStorage(str(DATA / name), cv2.FileStorage_WRITE)
    for key, value in values.items():
        file.write(key, value)
    file.release()


def matlab_camera(matrix, distortion, size):
    shifted = matrix.copy()
    shifted[:2, 2] += 1.0  # the first pixel of MATLAB is (1, 1)
    return {
        "RadialDistortion": distortion[[0, 1, 4]].reshape(1, 3),
        "TangentialDistortion": distortion[[2, 3]].reshape(1, 2),
        "ImageSize": np.array([[size[1], size[0]]], float),
        "WorldUnits": "mm",
        "IntrinsicMatrix": shifted.T,
    }


def as_lists(value):
    if isinstance(value, dict):
        return {key: as_lists(item) for key, item in value.items()}
    if isinstance(value, np.ndarray):  # jsonencode writes a row as a list
        return value.reshape(-1).tolist() if 1 in value.shape else value.tolist()
    return value


def main():
    DATA.mkdir(exist_ok=True)
    storage(
        "slstudio.xml",
        {
            "Kc": CAMERA,
            "kc": CAMERA_D.reshape(5, 1),
            "Kp": PROJECTOR,
            "kp": PROJECTOR_D.reshape(5, 1),
            "Rp": ROTATION,
            "Tp": TRANSLATION,
            "cam_error": 0.2,
            "proj_error": 0.3,
            "stereo_error": 0.3,
            "frameWidth": SIZE[0],
            "frameHeight": SIZE[1],
            "screenResX": PROJECTOR_SIZE[0],
            "screenResY": PROJECTOR_SIZE[1],
        },
    )
    storage(
        "scan3d.yml",
        {
            "cam_K": CAMERA,
            "cam_kc": CAMERA_D.reshape(1, 5),
            "proj_K": PROJECTOR,
            "proj_kc": PROJECTOR_D.reshape(1, 5),
            "R": ROTATION,
            "T": TRANSLATION,
        },
    )
    storage(
        "intrinsics.yml", {"M1": CAMERA, "D1": CAMERA_D.reshape(1, 5), "M2": PROJECTOR, "D2": PROJECTOR_D.reshape(1, 5)}
    )
    storage("extrinsics.yml", {"R": ROTATION, "T": TRANSLATION})
    storage(
        "camera.yml",
        {
            "image_width": SIZE[0],
            "image_height": SIZE[1],
            "camera_matrix": CAMERA,
            "distortion_coefficients": CAMERA_D.reshape(5, 1),
        },
    )
    stereo = {
        "CameraParameters1": matlab_camera(CAMERA, CAMERA_D, SIZE),
        "CameraParameters2": matlab_camera(PROJECTOR, PROJECTOR_D, PROJECTOR_SIZE),
        "RotationOfCamera2": ROTATION.T,
        "TranslationOfCamera2": TRANSLATION.T,
    }
    scipy.io.savemat(DATA / "matlab-v5.mat", stereo)
    scipy.io.savemat(DATA / "matlab-v7.mat", {"stereoParams": stereo}, do_compression=True)
    (DATA / "matlab.json").write_text(json.dumps(as_lists(stereo), indent=1) + "\n")
    toolbox = {
        "fc_left": np.array([[CAMERA[0, 0]], [CAMERA[1, 1]]]),
        "cc_left": CAMERA[:2, 2:],
        "alpha_c_left": np.zeros((1, 1)),
        "kc_left": CAMERA_D.reshape(5, 1),
        "fc_right": np.array([[PROJECTOR[0, 0]], [PROJECTOR[1, 1]]]),
        "cc_right": PROJECTOR[:2, 2:],
        "alpha_c_right": np.zeros((1, 1)),
        "kc_right": PROJECTOR_D.reshape(5, 1),
        "om": cv2.Rodrigues(ROTATION)[0],
        "T": TRANSLATION,
        "nx": float(SIZE[0]),
        "ny": float(SIZE[1]),
    }
    scipy.io.savemat(DATA / "Calib_Results_stereo.mat", toolbox)
    half = np.array([0.5, 0.5])  # the corner of COLMAP's first pixel is (0, 0)
    lines = ["# Camera list with one line of data per camera:", "#   CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]"]
    for number, (matrix, d, size) in enumerate([(CAMERA, CAMERA_D, SIZE), (PROJECTOR, PROJECTOR_D, PROJECTOR_SIZE)], 1):
        values = [matrix[0, 0], matrix[1, 1], *(matrix[:2, 2] + half), *d, 0.0, 0.0, 0.0]
        lines.append(" ".join([str(number), "FULL_OPENCV", *map(str, size), *(repr(float(v)) for v in values)]))
    (DATA / "cameras.txt").write_text("\n".join(lines) + "\n")
    ros = {"image_width": SIZE[0], "image_height": SIZE[1]}
    text = "".join(f"{key}: {value}\n" for key, value in ros.items())
    text += "camera_name: left\n"
    for key, matrix in (("camera_matrix", CAMERA), ("distortion_coefficients", CAMERA_D.reshape(1, 5))):
        text += f"{key}:\n  rows: {matrix.shape[0]}\n  cols: {matrix.shape[1]}\n  data: [{', '.join(map(repr, matrix.reshape(-1).tolist()))}]\n"
    (DATA / "ros.yaml").write_text(text)
    zero = np.zeros(3)
    camera_px = cv2.projectPoints(POINTS, zero, zero, CAMERA, CAMERA_D)[0].reshape(-1, 2)
    projector_px = cv2.projectPoints(POINTS, cv2.Rodrigues(ROTATION)[0], TRANSLATION, PROJECTOR, PROJECTOR_D)[
        0
    ].reshape(-1, 2)
    (DATA / "points.json").write_text(
        json.dumps(
            {"points": POINTS.tolist(), "camera_px": camera_px.tolist(), "projector_px": projector_px.tolist()},
            indent=1,
        )
        + "\n"
    )


if __name__ == "__main__":
    main()
