#pragma once

#include "frangia/core/image.h"

namespace frangia {

/// The plane `mean + slope_x * dx + slope_y * dy` that fits an image best over a square window.
struct WindowFit {
  float mean = 0.0F;
  float slope_x = 0.0F;  ///< per pixel
  float slope_y = 0.0F;
  float variance = 0.0F;  ///< of the values about the plane
};

/// Least-squares planes over the (2 radius + 1)^2 window about each pixel.
///
/// shape    as the image
/// missing  NaN in the image; a window that holds one, or leaves the image, has NaN everywhere
[[nodiscard]] Image<WindowFit> fit_windows(const Image<float>& image, int radius);

}  // namespace frangia
