#pragma once

#include "frangia/core/image.h"
#include "frangia/frames/png.h"

namespace frangia {

enum class Palette {
  Grey,     ///< black to white: the saw-tooth of a wrapped phase reads best so
  Viridis,  ///< dark blue to yellow, even in lightness, safe for colour-blind eyes
};

/// A number in [0, 1] as a colour; outside it is clamped.
[[nodiscard]] Rgb colour_of(double share, Palette palette);

struct ValueRange {
  float low = 0.0F;
  float high = 1.0F;
};

/// From the 1st to the 99th percentile of what is not missing, so that a few strays do not take the
/// whole scale.
[[nodiscard]] ValueRange usual_range(const Image<float>& values);

/// A map as a picture. Missing values are a dark blue-grey that no palette holds.
[[nodiscard]] Image<Rgb> picture_of(const Image<float>& values, ValueRange range, Palette palette);

}  // namespace frangia
