#pragma once

#include <cstddef>
#include <limits>

#include <Eigen/Geometry>

#include "frangia/core/run.h"
#include "frangia/rig/camera_model.h"
#include "frangia/views/view_store.h"

namespace frangia {

/// The region of the object frame whose points are kept.
struct Clip {
  /// Points in front of this plane are kept; a minimum height h is {UnitZ, -h}.
  Eigen::Hyperplane<double, 3> floor{Eigen::Vector3d::UnitZ(),
                                     std::numeric_limits<double>::infinity()};
  double max_radius_mm = std::numeric_limits<double>::infinity();  ///< from the axis
};

/// As `clip_views`, but nothing may be left.
///
/// @errors   Error(Input) when a view and the camera differ in size
std::size_t clip_views_to_nothing(ViewStore& views,
                                  const CameraModel& camera,
                                  const Clip& clip,
                                  const Run& run = {});

/// Removes the points outside of the clip from all views, before they can affect the registration
/// or the mesh. Returns the number of removed points.
///
/// @units    mm, object frame
/// @missing  a removed point is NaN
/// @errors   Error(Input) when no point is left, or a view and the camera differ in size
std::size_t clip_views(ViewStore& views,
                       const CameraModel& camera,
                       const Clip& clip,
                       const Run& run = {});

}  // namespace frangia
