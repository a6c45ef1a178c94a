#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// The color of screen values from 0 to 1; other values are clipped.
///
/// @missing  NaN gives 0
[[nodiscard]] inline VertexColor color_of(float red, float green, float blue) {
  const auto byte = [](float value) {
    const float clipped = value > 0.0F ? std::min(value, 1.0F) : 0.0F;
    return static_cast<std::uint8_t>(std::lround(255.0F * clipped));
  };
  return {byte(red), byte(green), byte(blue)};
}

}  // namespace frangia
