#pragma once

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/core/missing.h"
#include "frangia/local_fit/fit_windows.h"

namespace frangia {

inline constexpr int kQuadraticRadius = 2;

/// A paraboloid through what there is of the 5 x 5 pixels about one.
struct QuadraticFit {
  WindowFit window;       ///< about the pixel: `value` and slopes are the paraboloid's there
  float variance = 0.0F;  ///< what is left in `value` of a pixel's noise
};

/// Least squares over the pixels that are not missing.
///
/// missing  NaN where too few pixels, or pixels on too few sides, determine it
[[nodiscard]] QuadraticFit fit_quadratic(const Image<float>& image, const Eigen::Vector2i& at);

/// Correlation of what a patch leaves over at neighbouring pixels: of noise it is negative, of an
/// edge or a step positive.
[[nodiscard]] float residual_autocorrelation(const Image<float>& image,
                                             const Eigen::Vector2i& at,
                                             const WindowFit& patch);

}  // namespace frangia
