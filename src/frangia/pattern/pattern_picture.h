#pragma once

#include "frangia/core/image.h"
#include "frangia/pattern/pattern.h"
#include "frangia/pattern/pixel_layout.h"

namespace frangia {

/// Renders one frame of a pattern for a digital projector.
///
/// @shape    width x height pixels of the image that the projector is given
/// @units    linear light from 0 (dark) to 1 (full)
/// @errors   Error(Input) for a pattern of kind line, for fringes without a period, or for a frame
///          number out of range
[[nodiscard]] Image<float> pattern_picture(const Pattern& pattern,
                                           int frame,
                                           int width,
                                           int height,
                                           PixelLayout layout = PixelLayout::Square);

}  // namespace frangia
