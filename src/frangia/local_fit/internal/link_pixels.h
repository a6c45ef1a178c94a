#pragma once

#include <cstdint>

#include "frangia/core/image.h"
#include "frangia/range/range_grid.h"
#include "frangia/rig/camera_model.h"

namespace frangia {

/// Inverse depths of a view, and which neighbouring pixels lie on one surface.
///
/// @units    1/mm
/// @missing  q is NaN where nothing was measured
struct LinkedPixels {
  enum Link : std::uint8_t { Right = 1, Down = 2 };

  Image<float> q;             ///< inverse depth, as measured
  Image<float> noise;         ///< its standard deviation
  Image<std::uint8_t> links;  ///< bits of `Link`

  [[nodiscard]] bool has(int x, int y, Link link) const { return (links(x, y) & link) != 0; }
};

/// Links neighbouring pixels in a box unless the line that joins their points is within 8 degrees
/// of the viewing ray by more than 4 sigmas of their noise.
///
/// @shape    that of the part of `box` inside of the grid; (0, 0) is its upper left pixel
[[nodiscard]] LinkedPixels link_pixels(const RangeGrid& range,
                                       const CameraModel& camera,
                                       const PixelBox& box = {});

}  // namespace frangia
