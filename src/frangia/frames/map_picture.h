#pragma once

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/frames/png.h"

namespace frangia {

/// Colors for the values of a map.
enum class ColorMap {
  Gray,      ///< black to white, for wrapped phase
  Viridis,   ///< dark blue to yellow, for magnitudes
  Diverging  ///< blue over white to red, for signed deviations
};

/// Returns the colour of a value between 0 and 1. Values outside this range get the colour of the
/// nearer end.
///
/// @units    red, green, blue from 0 to 1
/// @missing  NaN is grey
[[nodiscard]] Eigen::Vector3f color_of(ColorMap map, float value);

/// Returns `color_of` as an 8-bit pixel.
[[nodiscard]] Rgb pixel_of(ColorMap map, float value);

/// The values at the two ends of a color map.
struct ValueRange {
  float low = 0.0F;   ///< value of the first color; lower values have it, too
  float high = 1.0F;  ///< value of the last color; higher values have it, too
};

/// Returns the 1st and 99th percentiles, so that a few outliers do not determine the scale.
///
/// @missing  NaN values are ignored
[[nodiscard]] ValueRange percentile_range(const Image<float>& values);

/// Renders a map of values as a picture.
///
/// @missing  NaN becomes a dark blue-grey that occurs in no color map
[[nodiscard]] Image<Rgb> map_picture(const Image<float>& values, ValueRange range, ColorMap map);

}  // namespace frangia
