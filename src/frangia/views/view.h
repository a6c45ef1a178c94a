#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "frangia/range/range_grid.h"

namespace frangia {

/// One range grid and where the object stood when it was seen.
///
/// What lies beside an edge is good enough for a surface that nothing else shows, but not to find
/// poses by: it is kept aside, see `recover_edge_pixels`, until `add_edge_pixels`.
struct View {
  RangeGrid range;
  Eigen::Isometry3d rig_from_object = Eigen::Isometry3d::Identity();
  std::vector<RangePixel> edge_pixels;  ///< missing in `range`
};

}  // namespace frangia
