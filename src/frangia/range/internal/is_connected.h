#pragma once

#include <cmath>

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/range/range_grid.h"

namespace frangia {

/// Whether two neighbouring pixels can lie on one continuous surface: their depths differ by at
/// most `max_slope` times their lateral distance plus 4 sigmas of noise.
///
/// @missing  false where either pixel is missing
[[nodiscard]] inline bool is_connected(const RangeGrid& range,
                                       const Image<Eigen::Vector2f>& rays,
                                       const Eigen::Vector2i& one,
                                       const Eigen::Vector2i& other,
                                       float max_slope) {
  constexpr float kNoiseSigmas = 4.0F;  // of the difference in depth
  const float a = range.depth_mm(one.x(), one.y());
  const float b = range.depth_mm(other.x(), other.y());
  const float across =
      (rays(one.x(), one.y()) - rays(other.x(), other.y())).norm() * 0.5F * (a + b);
  const float noise =
      std::hypot(range.sigma_mm(one.x(), one.y()), range.sigma_mm(other.x(), other.y()));
  return std::abs(a - b) <= max_slope * across + kNoiseSigmas * noise;
}

}  // namespace frangia
