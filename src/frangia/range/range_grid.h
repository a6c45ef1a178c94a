#pragma once

#include "frangia/core/image.h"

namespace frangia {

/// The surface as one camera sees it: a depth for each pixel, in the rig frame. NaN is missing.
/// The point of pixel (x, y) is `depth_mm * (ray.x, ray.y, 1)`, with `ray` from `rays_of(model)`.
struct RangeGrid {
  Image<float> depth_mm;  ///< z, along the optical axis
  Image<float> sigma_mm;  ///< standard deviation of the point along its viewing ray
};

/// One pixel of a range grid, by itself.
struct RangePixel {
  int x = 0;
  int y = 0;
  float depth_mm = 0.0F;
  float sigma_mm = 0.0F;
};

}  // namespace frangia
