#pragma once

#include <Eigen/Geometry>

#include "frangia/range/range_grid.h"

namespace frangia {

/// One range grid and where the object stood when it was seen.
struct View {
  RangeGrid range;
  Eigen::Isometry3d rig_from_object = Eigen::Isometry3d::Identity();
};

}  // namespace frangia
