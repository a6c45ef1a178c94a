#pragma once

#include <string_view>

#include "frangia/core/image.h"
#include "frangia/frames/png.h"

namespace frangia {

/// Width of a text from the left edge of its first letter to the right edge of its last.
///
/// @units    pixels, for capitals `cap_height` pixels high
[[nodiscard]] double text_width(std::string_view text, double cap_height);

/// Where a text stands in a picture.
struct TextPlacement {
  double x = 0.0;            ///< left edge, pixels
  double baseline = 0.0;     ///< pixels from the top
  double cap_height = 12.0;  ///< pixels
};

/// Draws one line of ASCII text with antialiased strokes. All digits have the same width. Parts
/// outside the picture are clipped.
///
/// @missing  other characters are drawn as an empty box
void draw_text(Image<Rgb>& picture,
               std::string_view text,
               const TextPlacement& placement,
               const Rgb& color);

}  // namespace frangia
