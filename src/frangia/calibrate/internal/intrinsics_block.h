#pragma once

#include <array>

#include "frangia/rig/camera_model.h"

namespace frangia {

/// The intrinsics of a model as an adjustment has them: fx fy/fx cx cy k1 k2 p1 p2 k3.
[[nodiscard]] std::array<double, 9> intrinsics_block(const CameraModel& model);

/// The model with these intrinsics; its further coefficients of distortion stay.
[[nodiscard]] CameraModel with_intrinsics(CameraModel model, const std::array<double, 9>& values);

}  // namespace frangia
