#pragma once

#include <cstddef>

#include "frangia/rig/rig.h"

namespace frangia {

/// Returns the rig as a rig with one camera: its frame is that of the given camera. What works with
/// the reference camera works with every other one in its own frame. The object frame stays that of
/// the reference camera.
///
/// @missing  the covariance of the calibration is that of the reference camera, and is left out for
///           the others
[[nodiscard]] Rig rig_of_camera(const Rig& rig, std::size_t camera);

}  // namespace frangia
