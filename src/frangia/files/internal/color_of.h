#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

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

/// The colors of numbers whose format allows 1 or 255 for full light: where one is larger than 2,
/// as no rounding of 1 is, it is 255.
[[nodiscard]] inline std::vector<VertexColor> colors_of(
    const std::vector<Eigen::Vector3f>& values) {
  constexpr float kRounded = 2.0F;
  const float full =
      std::any_of(values.begin(),
                  values.end(),
                  [](const Eigen::Vector3f& value) { return value.maxCoeff() > kRounded; })
          ? 255.0F
          : 1.0F;
  std::vector<VertexColor> colors;
  colors.reserve(values.size());
  for (const Eigen::Vector3f& value : values)
    colors.push_back(color_of(value.x() / full, value.y() / full, value.z() / full));
  return colors;
}

}  // namespace frangia
