#pragma once

#include "frangia/core/image.h"

namespace frangia {

/// How far from its centre a pixel looks, as a standard deviation along each axis of the picture.
///
/// Light that is spread unevenly over a pixel, vibration and an imperfect lens move the place that
/// a pixel measures. On a surface that slopes away this is depth noise which the phase knows
/// nothing of: what neighbours scatter by about a smooth surface, beyond their phase's noise, per
/// slope.
/// shape    both w x h: a value that is linear over planes, and its standard deviation
/// units    px
/// missing  0 where too few windows slope enough to tell
[[nodiscard]] float estimate_lateral_noise(const Image<float>& image, const Image<float>& noise);

}  // namespace frangia
