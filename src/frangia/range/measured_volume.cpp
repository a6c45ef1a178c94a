#include "frangia/range/measured_volume.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "frangia/core/vectorized.h"

namespace frangia {
namespace {

FRANGIA_VECTORIZED bool has_value(const float* values, std::ptrdiff_t count) {
  std::int32_t found = 0;
  for (std::ptrdiff_t i = 0; i < count; ++i)
    found |= values[i] == values[i] ? 1 : 0;  // false for NaN
  return found != 0;
}

}  // namespace

PixelBox measured_box(const Image<float>& image) {
  PixelBox box{image.width(), image.height(), 0, 0};
  for (int y = 0; y < image.height(); ++y) {
    const float* row = &image(0, y);
    if (!has_value(row, image.width())) continue;
    box.top = std::min(box.top, y);
    box.bottom = y + 1;
    int x = 0;
    while (x < box.left && std::isnan(row[x]))
      ++x;
    box.left = std::min(box.left, x);
    x = image.width();
    while (x > box.right && std::isnan(row[x - 1]))
      --x;
    box.right = std::max(box.right, x);
  }
  return box.empty() ? PixelBox{0, 0, 0, 0} : box;
}

}  // namespace frangia
