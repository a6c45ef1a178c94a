#pragma once

#include <span>

#include "frangia/local_fit/choose_window.h"

namespace frangia {

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
