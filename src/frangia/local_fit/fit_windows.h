#pragma once

#include "frangia/core/image.h"
#include "frangia/local_fit/window_fits.h"

namespace frangia {

/// Fits planes and quadratics over the (2 radius + 1)^2 window around each pixel of the rows
/// [first, first + rows).
///
/// @shape    as wide as the image
/// @missing  a window that holds a NaN or leaves the image has NaN in all quantities
/// @errors   Error(Input) unless the radius is 1, 2 or 3
/// @source   `value`: Savitzky & Golay 1964, in two dimensions
[[nodiscard]] WindowFits fit_windows(const Image<float>& image, int radius, int first, int rows);

}  // namespace frangia
