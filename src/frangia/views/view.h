#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/range/range_grid.h"

namespace frangia {

/// Red, green and blue from 0 to 255 as a screen shows them (sRGB).
using PixelColor = std::array<std::uint8_t, 3>;

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
  Image<PixelColor> color = {};         ///< of each pixel; empty: not known
};

}  // namespace frangia
