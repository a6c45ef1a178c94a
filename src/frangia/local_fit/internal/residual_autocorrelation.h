#pragma once

#include <span>

#include "frangia/local_fit/choose_window.h"

namespace frangia {

/// Correlation of what the paraboloids about the pixels of row `y` leave over at neighbouring
/// pixels: of noise it is negative, however loud, of an edge or a step positive.
///
/// shape    `windows` of 7 x 7 pixels of the image; `autocorrelation`: one a column
/// missing  NaN where there is no window
void window_autocorrelation(const Image<float>& image,
                            const WindowRows& windows,
                            int y,
                            std::span<float> autocorrelation);

}  // namespace frangia
