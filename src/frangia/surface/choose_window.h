#pragma once

#include <Eigen/Core>

#include "frangia/surface/fit_windows.h"

namespace frangia {

/// `fit_windows` of some rows of an image.
struct WindowRows {
  WindowRows(const Image<float>& image, int radius_px, int first_row, int rows)
      : radius(radius_px), first(first_row - radius_px), fits(image.width(), rows + 2 * radius_px) {
    fit_windows(image, radius, first, fits);
  }
  /// The fit about pixel (x, y), which may be `radius` beside the rows, or the image.
  [[nodiscard]] WindowFit at(int x, int y) const {
    return x < 0 || x >= fits.width() ? kNoFit : fits(x, y - first);
  }

  int radius;
  int first;
  Image<WindowFit> fits;
};

/// The plane that an image follows at a pixel, never rounded off by what lies across an edge: the
/// window about the pixel when it fits as well as noise allows, else the best of those that hold
/// the pixel, else the best of 3 x 3 pixels.
///
/// shape    one pixel, in one of the rows; `noise` is its standard deviation
/// missing  NaN where the pixel lies off even the best plane: there the image is rougher than its
/// pixels source   Kuwahara et al. 1976
[[nodiscard]] WindowFit choose_window(const Image<float>& image,
                                      const WindowRows& fits,
                                      const Eigen::Vector2i& at,
                                      float noise);

}  // namespace frangia
