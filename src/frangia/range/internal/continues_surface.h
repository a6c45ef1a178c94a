#pragma once

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/range/range_grid.h"

namespace frangia {

/// The pixels of a view that see a single surface.
struct ReliablePixels {
  const RangeGrid& range;
  const Image<Eigen::Vector2f>& rays;
  float max_slope;  ///< see `is_connected`
};

/// Whether a pixel that is not reliable continues the surface next to it in depth and brightness.
///
/// The reliable pixels around it that are connected to one of its neighbours are extrapolated by
/// quadratic fits of inverse depth and of light. A pixel that mixes two surfaces lies off the first
/// surface. A pixel only partly covered by the surface, at a silhouette or a shadow, is darker.
/// Phase noise falls with the square root of the light, so sigma stands in for brightness.
///
/// @missing  false where too few reliable pixels determine the fits
[[nodiscard]] bool continues_surface(const ReliablePixels& reliable, const RangePixel& pixel);

}  // namespace frangia
