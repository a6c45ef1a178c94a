#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/rig/rig.h"

namespace frangia {

/// An axis about which most views turned.
struct TurntableOfPoses {
  Turntable table;                 ///< its point is the one nearest to the camera
  std::vector<std::size_t> views;  ///< those that turned about it by their angles, ascending
};

/// Finds the axis about which a part turned, from the poses in which its views fit together.
///
/// Every two views state an axis; the one that most views follow to within 2 degrees, and 2 % of
/// the distance, is fitted to these views.
///
/// @units    mm, rad
/// @shape    `rig_from_object`, `angles_rad`: commanded, one a view; at least three views
/// @missing  no views where fewer than three agree, or none of their angles differ
/// @errors   Error(Input) when the numbers of poses and angles differ
[[nodiscard]] TurntableOfPoses turntable_of_poses(
    std::span<const Eigen::Isometry3d> rig_from_object, std::span<const double> angles_rad);

}  // namespace frangia
