#pragma once

#include "frangia/core/image.h"
#include "frangia/core/missing.h"

namespace frangia {

/// The plane `mean + slope_x * dx + slope_y * dy` that fits an image best over a square window.
struct WindowFit {
  float mean = 0.0F;
  float slope_x = 0.0F;  ///< per pixel
  float slope_y = 0.0F;
  float variance = 0.0F;  ///< of the values about the plane
  float middle = 0.0F;    ///< what the best paraboloid has at the window's centre
  float rest = 0.0F;      ///< variance of the values about that paraboloid
  /// Correlation of what the paraboloid leaves over at neighbouring pixels: of noise it is
  /// negative, however loud, of an edge or a step positive.
  float structure = 0.0F;
};

/// What a window has that cannot be fitted.
inline constexpr WindowFit kNoFit{
    kMissing, kMissing, kMissing, kMissing, kMissing, kMissing, kMissing};

/// What is left in `middle` of a pixel's noise, in variance.
[[nodiscard]] constexpr float middle_variance(int radius) {
  return radius == 1 ? 5.0F / 9.0F : radius == 2 ? 27.0F / 175.0F : 11.0F / 147.0F;
}

/// Least-squares planes over the (2 radius + 1)^2 window about each pixel of the rows from `first`
/// on.
///
/// shape    `fits` has the image's width and as many rows as are wanted
/// missing  NaN in the image; a window that holds one, or leaves the image, has NaN everywhere
/// errors   Error(Input) unless the radius is 1, 2 or 3
/// source   `middle`: Savitzky & Golay 1964, in two dimensions
void fit_windows(const Image<float>& image, int radius, int first, Image<WindowFit>& fits);

}  // namespace frangia
