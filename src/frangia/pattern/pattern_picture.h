#pragma once

#include "frangia/core/image.h"
#include "frangia/pattern/pattern.h"

namespace frangia {

/// What a digital projector must show for one frame of a pattern.
///
/// shape    width x height pixels of the projector
/// units    light, linear: 0 dark, 1 as bright as can be
/// errors   Error(Input) for a line, for fringes without a period, or a frame that there is not
[[nodiscard]] Image<float> pattern_picture(const Pattern& pattern,
                                           int frame,
                                           int width,
                                           int height);

}  // namespace frangia
