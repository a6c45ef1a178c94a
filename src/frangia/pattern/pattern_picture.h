#pragma once

#include "frangia/core/image.h"
#include "frangia/pattern/pattern.h"

namespace frangia {

/// Renders one frame of a pattern for a digital projector.
///
/// @shape    width x height projector pixels
/// @units    linear light from 0 (dark) to 1 (full)
/// @errors   Error(Input) for a pattern of kind line, for fringes without a period, or for a frame
///          number out of range
[[nodiscard]] Image<float> pattern_picture(const Pattern& pattern,
                                           int frame,
                                           int width,
                                           int height);

}  // namespace frangia
