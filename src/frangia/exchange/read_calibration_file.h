#pragma once

#include <filesystem>
#include <span>

#include "frangia/core/run.h"
#include "frangia/exchange/foreign_calibration.h"

namespace frangia {

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
/// @missing  what no file states is empty
/// @errors   Error(Input) that names the file: it is unreadable, of another kind, or states no
///          calibration; Error(Cancelled)
/// @source   OpenCV, samples/cpp/stereo_calib.cpp; SLStudio, src/calibrator/CalibrationData.cpp;
///          scan3d-capture, src/CalibrationData.cpp; MATLAB, stereoParameters; Bouguet, Camera
///          Calibration Toolbox; COLMAP, src/colmap/sensor/models.h
[[nodiscard]] ForeignCalibration read_calibration_files(
    std::span<const std::filesystem::path> files, const Run& run = {});

}  // namespace frangia
