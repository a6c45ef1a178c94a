#include "frangia/frames/map_picture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "frangia/core/parallel.h"

namespace frangia {
namespace {

constexpr Rgb kMissingColor{36, 40, 52};

}  // namespace

Rgb pixel_of(ColorMap map, float value) {
  const Eigen::Vector3f color = 255.0F * color_of(map, value);
  return {static_cast<std::uint8_t>(std::lround(color.x())),
          static_cast<std::uint8_t>(std::lround(color.y())),
          static_cast<std::uint8_t>(std::lround(color.z()))};
}

ValueRange percentile_range(const Image<float>& values) {
  std::vector<float> known;
  for (const float value : values.pixels()) {
    if (!std::isnan(value)) known.push_back(value);
  }
  if (known.empty()) return {};
  const auto at = [&](double share) {
    const auto rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(known.size() - 1));
    std::nth_element(known.begin(), known.begin() + rank, known.end());
    return known[static_cast<std::size_t>(rank)];
  };
  return {at(0.01), at(0.99)};
}

Image<Rgb> map_picture(const Image<float>& values, ValueRange range, ColorMap map) {
  Image<Rgb> picture(values.width(), values.height(), kMissingColor);
  const float width = std::max(range.high - range.low, 1e-12F);
  parallel_rows(values.height(), [&](int y) {
    for (int x = 0; x < values.width(); ++x) {
      const float value = values(x, y);
      if (!std::isnan(value)) picture(x, y) = pixel_of(map, (value - range.low) / width);
    }
  });
  return picture;
}

}  // namespace frangia
