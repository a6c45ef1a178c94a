#pragma once

#include <cstddef>

#include <Eigen/Geometry>

#include "frangia/rig/rig.h"

namespace frangia {

/// Number of cameras of a rig, with the reference camera.
[[nodiscard]] std::size_t camera_count(const Rig& rig);

/// Projection of a camera: 0 is the reference camera, the others follow in the order of
/// `more_cameras`.
[[nodiscard]] const CameraModel& model_of_camera(const Rig& rig, std::size_t camera);

/// Transforms from the rig frame to the frame of a camera: 0 is the reference camera, the others
/// follow in the order of `more_cameras`.
[[nodiscard]] Eigen::Isometry3d camera_from_rig(const Rig& rig, std::size_t camera);

/// Returns the rig as a rig with one camera: its frame is that of the given camera. What works with
/// the reference camera works with every other one in its own frame. The object frame stays that of
/// the reference camera.
///
/// @missing  the covariance of the calibration is that of the reference camera, and is left out for
///           the others
[[nodiscard]] Rig rig_of_camera(const Rig& rig, std::size_t camera);

}  // namespace frangia
