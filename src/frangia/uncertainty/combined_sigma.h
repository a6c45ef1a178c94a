#pragma once

#include <cmath>

namespace frangia {

/// Combines the two parts of a standard uncertainty, which are independent of each other.
///
/// @units    those of the parts
/// @missing  NaN when a part is NaN
/// @source   GUM (JCGM 100:2008), 5.1.2
[[nodiscard]] inline float combined_sigma(float noise, float systematic) {
  return std::sqrt(noise * noise + systematic * systematic);
}

}  // namespace frangia
