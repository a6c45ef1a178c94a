#pragma once

#include <algorithm>
#include <cmath>

#include "frangia/core/angles.h"

namespace frangia {

/// Standard deviation, over the scale of a pixel, of counts that no model of fringes predicts.
inline constexpr double kOutlierSize = 0.4;
/// Width of the density of counts of fringes over the scale of a pixel: a frame that is darker or
/// brighter everywhere by less than a quarter of it is no sound one.
inline constexpr double kBroad = 0.35;

/// Log of the normal density of `count` values with this sum of squares.
[[nodiscard]] inline double log_normal(double square, double variance, double count) {
  return -0.5 * (square / variance + count * std::log(kTwoPi * variance));
}

/// Log of the sum of two densities, from their logs.
[[nodiscard]] inline double log_of_mixture(double a, double b) {
  const double larger = std::max(a, b);
  return larger + std::log(std::exp(a - larger) + std::exp(b - larger));
}

/// Log density of the counts of a frame that shows anything at a pixel: normal about half of the
/// scale.
[[nodiscard]] inline double log_density_of_anything(double counts, double scale) {
  const double sigma = kOutlierSize * scale;
  return log_normal(std::pow(counts - 0.5 * scale, 2), sigma * sigma, 1.0);
}

}  // namespace frangia
