#pragma once

#include "frangia/core/error.h"
#include "frangia/core/image.h"
#include "frangia/core/parallel.h"

namespace frangia {

/// Every `step`-th pixel of an image along both axes, beginning with pixel (0, 0).
///
/// @shape    width and height over the step, rounded up
/// @errors   Error(Input) when the step is less than one pixel
template <typename T>
[[nodiscard]] Image<T> every_nth_pixel(const Image<T>& image, int step) {
  require(step >= 1, "every_nth_pixel: the step must be at least one pixel");
  Image<T> out(
      (image.width() + step - 1) / step, (image.height() + step - 1) / step, Uninitialized{});
  parallel_rows(out.height(), [&](int y) {
    for (int x = 0; x < out.width(); ++x)
      out(x, y) = image(x * step, y * step);
  });
  return out;
}

}  // namespace frangia
