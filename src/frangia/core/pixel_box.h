#pragma once

#include <algorithm>
#include <limits>

namespace frangia {

/// A rectangle of pixels: columns [left, right) and rows [top, bottom). The default holds every
/// image.
///
/// @units    px
struct PixelBox {
  int left = 0;                                  ///< first column
  int top = 0;                                   ///< first row
  int right = std::numeric_limits<int>::max();   ///< column after the last one
  int bottom = std::numeric_limits<int>::max();  ///< row after the last one

  [[nodiscard]] int width() const { return right - left; }   ///< number of columns
  [[nodiscard]] int height() const { return bottom - top; }  ///< number of rows
  [[nodiscard]] bool empty() const {                         ///< whether it holds no pixel
    return right <= left || bottom <= top;
  }
  /// The part of the box inside of an image.
  [[nodiscard]] PixelBox within(int image_width, int image_height) const {
    return {std::max(left, 0),
            std::max(top, 0),
            std::min(right, image_width),
            std::min(bottom, image_height)};
  }
};

/// The box with `margin` more pixels on each side, as far as an image of `width` x `height` pixels
/// reaches. An empty box stays empty.
[[nodiscard]] inline PixelBox grow(const PixelBox& box, int margin, int width, int height) {
  if (box.empty()) return {0, 0, 0, 0};
  return PixelBox{box.left - margin, box.top - margin, box.right + margin, box.bottom + margin}
      .within(width, height);
}

}  // namespace frangia
