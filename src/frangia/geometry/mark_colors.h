#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// Diffuse colors of the marks as linear red, green, blue, indexed by Mark: measured light grey,
/// displaced yellow, synthesized blue. Pictures and the materials of files use them.
inline constexpr std::array<std::array<double, 3>, 3> kMarkColors{
    {{0.80, 0.775, 0.74}, {0.80, 0.58, 0.12}, {0.12, 0.36, 0.72}}};

/// The color of a mark.
[[nodiscard]] inline const std::array<double, 3>& mark_color(Mark mark) {
  return kMarkColors.at(static_cast<std::size_t>(mark));
}

/// The color of a mark as red, green, blue of a screen with gamma 2.2.
[[nodiscard]] inline std::array<std::uint8_t, 3> mark_screen_color(Mark mark) {
  std::array<std::uint8_t, 3> bytes{};
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const double value = std::pow(mark_color(mark).at(i), 1.0 / 2.2);
    bytes.at(i) = static_cast<std::uint8_t>(std::lround(255.0 * value));
  }
  return bytes;
}

}  // namespace frangia
