#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "frangia/local_fit/fit_windows.h"

namespace frangia {

/// `fit_windows` of some rows of an image.
struct WindowRows {
  WindowRows(const Image<float>& image, int radius_px, int first_row, int rows)
      : radius(radius_px),
        first(first_row - radius_px),
        fits(fit_windows(image, radius, first, rows + 2 * radius_px)) {}
  /// The fit about pixel (x, y), which may be `radius` beside the rows, or the image.
  [[nodiscard]] WindowFit at(int x, int y) const {
    return x < 0 || x >= fits.width() ? kNoFit : fits.at(x, y - first);
  }

  int radius;
  int first;
  WindowFits fits;
};

/// About the pixel, so that its slope is that at the pixel, curved or not; beside it; or of 3 x 3
/// pixels.
enum class WindowKind : std::uint8_t { None, Centered, Shifted, Small };

/// What a pixel's value is uncertain by.
struct PixelNoise {
  float value = 0.0F;             ///< standard deviation of the value itself
  float lateral_noise_px = 0.0F;  ///< of the place that it belongs to, see `estimate_lateral_noise`

  [[nodiscard]] float variance(const WindowFit& fit) const {
    const float square = fit.slope_x * fit.slope_x + fit.slope_y * fit.slope_y;
    return value * value + lateral_noise_px * lateral_noise_px * square;
  }
};

struct ChosenWindow {
  WindowFit fit;
  WindowKind kind = WindowKind::None;
  float value = kMissing;     ///< the pixel's, with as little noise as the window leaves in it
  float variance = kMissing;  ///< of that value
};

/// A window fits as well as noise allows when it scatters by less than this, in its variance.
inline constexpr float kMaxScatterRatio = 2.0F;

/// The plane that an image follows at a pixel, never rounded off by what lies across an edge: that
/// of the window about the pixel when it fits as well as noise allows, else of 3 x 3 pixels about
/// it, else of the best window that holds the pixel, large or small.
///
/// shape    one pixel, in one of the rows
/// missing  NaN where the pixel lies off even the best plane: there the image is rougher than its
///          pixels
/// source   Kuwahara et al. 1976
[[nodiscard]] ChosenWindow choose_window(const Image<float>& image,
                                         const WindowRows& fits,
                                         const Eigen::Vector2i& at,
                                         const PixelNoise& noise);

}  // namespace frangia
