#pragma once

#include "frangia/core/image.h"
#include "frangia/core/pixel_box.h"

namespace frangia {

/// Finds the smallest box that holds every pixel with a value. A part usually covers a small share
/// of the image, so later stages leave out the rest.
///
/// @missing  NaN; the box is empty when all pixels are missing
[[nodiscard]] PixelBox measured_box(const Image<float>& image);

}  // namespace frangia
