#pragma once

#include "frangia/core/image.h"
#include "frangia/frames/color_map.h"
#include "frangia/frames/png.h"

namespace frangia {

/// `color_of` as a pixel.
[[nodiscard]] Rgb pixel_of(ColorMap map, float value);

struct ValueRange {
  float low = 0.0F;
  float high = 1.0F;
};

/// From the 1st to the 99th percentile of what is not missing, so that a few strays do not take the
/// whole scale.
[[nodiscard]] ValueRange percentile_range(const Image<float>& values);

/// A map as a picture. Missing values are a dark blue-grey that no color map holds.
[[nodiscard]] Image<Rgb> map_picture(const Image<float>& values, ValueRange range, ColorMap map);

}  // namespace frangia
