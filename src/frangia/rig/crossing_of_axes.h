#pragma once

#include <Eigen/Core>

#include "frangia/rig/rig.h"

namespace frangia {

/// The point in the middle between the axes of camera and projector where they are nearest.
///
/// @units    mm, rig frame
[[nodiscard]] Eigen::Vector3d crossing_of_axes(const Rig& rig);

}  // namespace frangia
