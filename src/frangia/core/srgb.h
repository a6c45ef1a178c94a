#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace frangia {

/// Light from 0 to 1 of a screen value from 0 to 255.
///
/// @source   IEC 61966-2-1 (sRGB)
[[nodiscard]] inline double linear_from_srgb(std::uint8_t value) {
  const double v = value / 255.0;
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

/// The screen value nearest to a light; light below 0 or above 1 is clipped.
///
/// @missing  NaN gives 0
/// @source   IEC 61966-2-1 (sRGB)
[[nodiscard]] inline std::uint8_t srgb_from_linear(double light) {
  const double l = light > 0.0 ? std::min(light, 1.0) : 0.0;
  const double v = l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1.0 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255.0 * v));
}

}  // namespace frangia
