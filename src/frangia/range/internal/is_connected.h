#pragma once

#include <cmath>

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/range/range_grid.h"

namespace frangia {

/// Noise that `is_connected` allows, in sigmas of the difference in depth.
inline constexpr float kConnectionSigmas = 4.0F;

/// std::hypot of floats as the GNU library computes it, inline, so that loops vectorize.
[[nodiscard]] inline float root_of_squares(float a, float b) {
  const auto x = static_cast<double>(a);
  const auto y = static_cast<double>(b);
  return static_cast<float>(std::sqrt(x * x + y * y));
}

/// Whether two neighbouring pixels can lie on one continuous surface: their depths differ by at
/// most `max_slope` times their lateral distance plus 4 sigmas of noise.
///
/// @missing  false where either pixel is missing
[[nodiscard]] inline bool is_connected(const RangeGrid& range,
                                       const Image<Eigen::Vector2f>& rays,
                                       const Eigen::Vector2i& one,
                                       const Eigen::Vector2i& other,
                                       float max_slope) {
  const float a = range.depth_mm(one.x(), one.y());
  const float b = range.depth_mm(other.x(), other.y());
  const float across =
      (rays(one.x(), one.y()) - rays(other.x(), other.y())).norm() * 0.5F * (a + b);
  const float noise =
      root_of_squares(range.sigma_mm(one.x(), one.y()), range.sigma_mm(other.x(), other.y()));
  return std::abs(a - b) <= max_slope * across + kConnectionSigmas * noise;
}

}  // namespace frangia
