#include "frangia/frames/color_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace frangia {
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
