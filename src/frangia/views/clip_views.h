#pragma once

#include <cstddef>
#include <limits>

#include <Eigen/Geometry>

#include "frangia/core/run.h"
#include "frangia/rig/camera_model.h"
#include "frangia/views/view_store.h"

namespace frangia {

/// What is kept of what was seen, in the object frame.
struct Clip {
  /// Only points in front of this plane; a height is {UnitZ, -height}.
  Eigen::Hyperplane<double, 3> floor{Eigen::Vector3d::UnitZ(),
                                     std::numeric_limits<double>::infinity()};
  double max_radius_mm = std::numeric_limits<double>::infinity();  ///< from the axis
};

/// Drops points from all views, so that they can neither capture the registration nor stay in the
/// mesh.
///
/// missing  a dropped point is NaN, as one that was never seen
/// errors   Error(Input) when no point is left
/// Returns how many points were dropped.
std::size_t clip_views(ViewStore& views,
                       const CameraModel& camera,
                       const Clip& clip,
                       const Run& run = {});

}  // namespace frangia
