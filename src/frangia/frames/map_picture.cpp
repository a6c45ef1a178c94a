#include "frangia/frames/map_picture.h"

#include <algorithm>
#include <array>
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

namespace {

using ColorStops = std::array<Eigen::Vector3f, 9>;

/// Viridis of matplotlib (Smith & van der Walt 2015), sampled at multiples of 1/8.
const ColorStops& viridis() {
  static const ColorStops stops{{{0.267F, 0.005F, 0.329F},
                                 {0.279F, 0.175F, 0.483F},
                                 {0.230F, 0.322F, 0.546F},
                                 {0.173F, 0.449F, 0.558F},
                                 {0.128F, 0.567F, 0.551F},
                                 {0.158F, 0.684F, 0.502F},
                                 {0.369F, 0.789F, 0.383F},
                                 {0.678F, 0.864F, 0.190F},
                                 {0.993F, 0.906F, 0.144F}}};
  return stops;
}

/// Moreland's smooth cool-warm map (2009), sampled at multiples of 1/8; the centre is light grey.
const ColorStops& cool_warm() {
  static const ColorStops stops{{{0.230F, 0.299F, 0.754F},
                                 {0.384F, 0.510F, 0.918F},
                                 {0.554F, 0.690F, 0.996F},
                                 {0.719F, 0.815F, 0.976F},
                                 {0.865F, 0.865F, 0.865F},
                                 {0.959F, 0.769F, 0.678F},
                                 {0.957F, 0.604F, 0.482F},
                                 {0.871F, 0.375F, 0.302F},
                                 {0.706F, 0.016F, 0.150F}}};
  return stops;
}

}  // namespace

Eigen::Vector3f color_of(ColorMap map, float value) {
  if (std::isnan(value)) return Eigen::Vector3f::Constant(0.5F);
  if (map == ColorMap::Gray) return Eigen::Vector3f::Constant(std::clamp(value, 0.0F, 1.0F));
  const ColorStops& stops = map == ColorMap::Viridis ? viridis() : cool_warm();
  const float position = std::clamp(value, 0.0F, 1.0F) * static_cast<float>(stops.size() - 1);
  const std::size_t low = std::min(static_cast<std::size_t>(position), stops.size() - 2);
  const float share = position - static_cast<float>(low);
  return (1.0F - share) * stops[low] + share * stops[low + 1];
}

}  // namespace frangia
