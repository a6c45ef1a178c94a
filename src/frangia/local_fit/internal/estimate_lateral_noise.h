#pragma once

#include <optional>
#include <span>

#include "frangia/core/image.h"
#include "frangia/local_fit/fit_windows.h"

namespace frangia {

/// Rows of a larger image.
struct ImageStrip {
  int top = 0;          ///< row of the larger image that is the first one of the strip
  int full_height = 0;  ///< of the larger image
};

/// Estimates the lateral localization noise: the standard deviation, along each axis of the image,
/// of the position that a pixel measures about its centre.
///
/// Uneven light within a pixel, vibration and an imperfect lens displace the measured position. On
/// an inclined surface this causes depth noise that the phase noise does not include. The estimate
/// is the scatter about a smooth surface in excess of the phase noise, divided by the slope.
///
/// Rows are sampled at fixed distances. Where the images are a strip of larger ones, `strip` keeps
/// the sample that of the larger ones.
///
/// @shape    both w x h: a value that is linear over planes, and its standard deviation
/// @units    px
/// @missing  0 when too few windows are usable
[[nodiscard]] float estimate_lateral_noise(const Image<float>& image,
                                           const Image<float>& noise,
                                           const std::optional<ImageStrip>& strip = {});

/// Autocorrelation at neighbouring pixels of the residuals of the quadratic fits around the pixels
/// of row `y`: negative for noise of any amplitude, positive for an edge or a step.
///
/// @shape    `windows` of 7 x 7 pixels; `autocorrelation` has one value for each column
/// @missing  NaN where no window fits
/// @errors   Error(Input) for windows of another size
void window_autocorrelation(const Image<float>& image,
                            const WindowRows& windows,
                            int y,
                            std::span<float> autocorrelation);

}  // namespace frangia
