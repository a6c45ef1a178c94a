#pragma once

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/core/missing.h"
#include "frangia/local_fit/fit_windows.h"

namespace frangia {

inline constexpr int kQuadraticRadius = 2;

/// A quadratic fit over the measured ones of the 5 x 5 pixels around a pixel.
struct QuadraticFit {
  WindowFit window;       ///< `mean` equals `value`, and `variance` equals `residual_variance`
  float variance = 0.0F;  ///< variance of `value` per pixel variance
};

/// Fits a quadratic by least squares over the measured pixels.
///
/// @missing  NaN where too few pixels, or pixels on too few sides, determine the fit
[[nodiscard]] QuadraticFit fit_quadratic(const Image<float>& image, const Eigen::Vector2i& at);

/// Autocorrelation of a fit's residuals at neighbouring pixels: negative for noise, positive for an
/// edge or a step.
[[nodiscard]] float residual_autocorrelation(const Image<float>& image,
                                             const Eigen::Vector2i& at,
                                             const WindowFit& patch);

}  // namespace frangia
