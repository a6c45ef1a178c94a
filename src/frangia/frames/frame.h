#pragma once

#include <cstdint>
#include <variant>

#include "frangia/core/image.h"

namespace frangia {

/// One grey image as the camera gave it. Eight-bit frames stay eight-bit: memory traffic is what
/// decoding costs.
using Frame = std::variant<Image<std::uint8_t>, Image<std::uint16_t>>;

[[nodiscard]] inline int width_of(const Frame& frame) {
  return std::visit([](const auto& image) { return image.width(); }, frame);
}
[[nodiscard]] inline int height_of(const Frame& frame) {
  return std::visit([](const auto& image) { return image.height(); }, frame);
}
/// The value of one pixel in counts, whatever the depth. For loops over pixels, visit instead.
[[nodiscard]] inline int counts_at(const Frame& frame, int x, int y) {
  return std::visit([&](const auto& image) { return static_cast<int>(image(x, y)); }, frame);
}

}  // namespace frangia
