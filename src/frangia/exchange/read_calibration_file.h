#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>

#include "frangia/core/run.h"
#include "frangia/exchange/foreign_calibration.h"

namespace frangia {

/// The names that files give to a matrix, by OpenCV's names: K1 and D1 of the camera, K2 and D2 of
/// the projector, R and T from camera to projector. For files with names of their own.
using CalibrationNames = std::map<std::string, std::string>;

/// Reads the calibration of a rig from files of another program. Several files complete each other,
/// such as intrinsics.yml and extrinsics.yml of OpenCV's stereo_calib.
///
/// ending            program
/// .yml .yaml .xml   OpenCV, SLStudio (calibration.xml), scan3d-capture, ROS (camera_info)
/// .mat              MATLAB, `toStruct(stereoParams)` or the Camera Calibration Toolbox; v5 and v7
/// .json             MATLAB, `jsonencode(toStruct(stereoParams))`; OpenCV
/// .txt              COLMAP, cameras.txt: the first camera, and the second as projector
///
/// The pixel origins of MATLAB (1, 1) and COLMAP (0.5, 0.5) and MATLAB's transposed matrices are
/// converted.
///
/// A lens model that OpenCV's 14 coefficients do not describe, such as fisheye, equidistant or
/// double sphere, is refused by its name. `run` is warned of a file that adds nothing.
///
/// @missing  what no file states is empty
/// @errors   Error(Input) that names the file: it is unreadable, of another kind, has a lens model
///          of another kind, or states no calibration; a name of `names` that no file has;
///          Error(Cancelled)
/// @source   OpenCV, samples/cpp/stereo_calib.cpp; SLStudio, src/calibrator/CalibrationData.cpp;
///          scan3d-capture, src/CalibrationData.cpp; MATLAB, stereoParameters; Bouguet, Camera
///          Calibration Toolbox; COLMAP, src/colmap/sensor/models.h
[[nodiscard]] ForeignCalibration read_calibration_files(
    std::span<const std::filesystem::path> files,
    const Run& run = {},
    const CalibrationNames& names = {});

}  // namespace frangia
