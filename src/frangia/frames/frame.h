#pragma once

#include <cstdint>
#include <variant>

#include "frangia/core/image.h"

namespace frangia {

/// A grey image as recorded by the camera. Eight-bit frames stay eight-bit, because memory traffic
/// limits the speed of decoding.
using Frame = std::variant<Image<std::uint8_t>, Image<std::uint16_t>>;

/// Returns the number of columns.
[[nodiscard]] inline int width_of(const Frame& frame) {
  return std::visit([](const auto& image) { return image.width(); }, frame);
}
/// Returns the number of rows.
[[nodiscard]] inline int height_of(const Frame& frame) {
  return std::visit([](const auto& image) { return image.height(); }, frame);
}
/// Returns the value of one pixel in counts. In loops over pixels, visit the variant once instead.
[[nodiscard]] inline int counts_at(const Frame& frame, int x, int y) {
  return std::visit([&](const auto& image) { return static_cast<int>(image(x, y)); }, frame);
}

}  // namespace frangia
