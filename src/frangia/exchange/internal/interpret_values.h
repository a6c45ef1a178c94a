#pragma once

#include "frangia/exchange/foreign_calibration.h"
#include "frangia/exchange/internal/named_values.h"

namespace frangia {

/// Recognizes a calibration by the names of OpenCV's samples and tutorials, SLStudio,
/// scan3d-capture and ROS.
///
/// @missing  what the values do not state is empty
/// @errors   Error(Input) without the name of the file: a lens model such as fisheye
[[nodiscard]] ForeignCalibration interpret_opencv_values(const NamedValues& values);

/// Recognizes a calibration by the names of MATLAB's stereoParameters, as toStruct writes them, and
/// of Bouguet's Camera Calibration Toolbox.
///
/// @missing  what the values do not state is empty
[[nodiscard]] ForeignCalibration interpret_matlab_values(const NamedValues& values);

/// Refuses a lens model that OpenCV's coefficients do not describe.
///
/// @errors   Error(Input) without the name of the file, which names the model
void check_lens_models(const NamedValues& values);

}  // namespace frangia
