#pragma once

#include "frangia/core/image.h"

namespace frangia {

/// Estimates the lateral localization noise: the standard deviation, along each axis of the image,
/// of the position that a pixel measures about its centre.
///
/// Uneven light within a pixel, vibration and an imperfect lens displace the measured position. On
/// an inclined surface this causes depth noise that the phase noise does not include. The estimate
/// is the scatter about a smooth surface in excess of the phase noise, divided by the slope.
///
/// @shape    both w x h: a value that is linear over planes, and its standard deviation
/// @units    px
/// @missing  0 when too few windows are usable
[[nodiscard]] float estimate_lateral_noise(const Image<float>& image, const Image<float>& noise);

}  // namespace frangia
