#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "frangia/range/range_grid.h"

namespace frangia {

/// A range grid and the pose of the object when it was measured.
///
/// Pixels recovered at edges are accurate enough for fusion but not for registration. They are
/// stored apart, see `recover_edge_pixels`, until `add_edge_pixels` adds them to the grid.
///
/// @units    mm, rig frame
struct View {
  RangeGrid range;  ///< measured points
  /// Pose of the object in the rig frame.
  Eigen::Isometry3d rig_from_object = Eigen::Isometry3d::Identity();
  std::vector<RangePixel> edge_pixels;  ///< missing in `range`
};

}  // namespace frangia
