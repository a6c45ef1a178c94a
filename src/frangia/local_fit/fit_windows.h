#pragma once

#include <cstdint>

#include <Eigen/Core>

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

/// The window fits of some rows of an image, with `radius` more rows on both sides.
struct WindowRows {
  /// Fits windows of radius `radius_px` for `rows` rows from `first_row`, with their margins.
  WindowRows(const Image<float>& image, int radius_px, int first_row, int rows)
      : radius(radius_px),
        first(first_row - radius_px),
        fits(fit_windows(image, radius, first, rows + 2 * radius_px)) {}
  /// The fit around pixel (x, y), which may lie up to `radius` outside of the rows or the image.
  [[nodiscard]] WindowFit at(int x, int y) const {
    return x < 0 || x >= fits.width() ? kNoFit : fits.at(x, y - first);
  }

  int radius;       ///< radius of the windows in pixels
  int first;        ///< first fitted row of the image, `radius` above the first of the rows
  WindowFits fits;  ///< row 0 is row `first` of the image
};

/// The position of a window relative to its pixel: none, around the pixel, a full window that holds
/// the pixel off its centre, or 3 x 3 pixels that hold it. On a curved surface only the slope of a
/// centered window is that at the pixel.
enum class WindowKind : std::uint8_t { None, Centered, Shifted, Small };

/// The noise of one pixel.
struct PixelNoise {
  float value = 0.0F;             ///< standard deviation of the value
  float lateral_noise_px = 0.0F;  ///< standard deviation of the pixel's position along each axis

  /// Returns the variance of the value, with that of the pixel's position on the slope of `fit`.
  [[nodiscard]] float variance(const WindowFit& fit) const {
    const float square = fit.slope_x * fit.slope_x + fit.slope_y * fit.slope_y;
    return value * value + lateral_noise_px * lateral_noise_px * square;
  }
};

/// The window of a pixel and the pixel's smoothed value.
struct ChosenWindow {
  WindowFit fit;                       ///< NaN where `kind` is None
  WindowKind kind = WindowKind::None;  ///< position of the window relative to the pixel
  float value = kMissing;              ///< the smoothed value at the pixel
  float variance = kMissing;           ///< variance of `value`
};

/// Thresholds of `choose_window`. Ratios compare a residual variance with that of the pixel's
/// noise.
///
/// Half or double of one threshold changes the RMS deviation of the shaft of `frangia demo`
/// (`frangia inspect shaft.ply --reference shaft-scan/truth.ply`: 0.036 mm) by -2 % to +7 %; the
/// most sensitive one is `max_flat_ratio`.
struct WindowChoiceOptions {
  float max_flat_ratio = 2.0F;  ///< of a plane: the window counts as flat
  /// Maximum autocorrelation of residuals that count as noise. That of noise is negative.
  float max_autocorrelation = 0.0F;
};

/// Chooses the window whose plane follows the image at a pixel without smoothing across an edge.
///
/// The candidates are, in this order: the window around the pixel if it is flat to within the
/// noise; a quadratic fit over the same pixels if its residuals are noise; 3 x 3 pixels around the
/// pixel; the best window of full size, and then of 3 x 3 pixels, that holds the pixel.
///
/// @shape    `at` is a measured pixel in one of the rows of `fits`
/// @missing  kind None and NaN where the pixel lies off even the best plane
/// @source   the choice among shifted windows: Kuwahara et al. 1976
[[nodiscard]] ChosenWindow choose_window(const Image<float>& image,
                                         const WindowRows& fits,
                                         const Eigen::Vector2i& at,
                                         const PixelNoise& noise,
                                         const WindowChoiceOptions& options = {});

}  // namespace frangia
