#pragma once

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/core/missing.h"
#include "frangia/views/fit_windows.h"

namespace frangia {

inline constexpr int kPatchRadius = 2;

/// A paraboloid through what there is of the 5 x 5 pixels about one.
struct PatchFit {
  WindowFit window;       ///< about the pixel: `middle` and slopes are the paraboloid's there
  float variance = 0.0F;  ///< what is left in `middle` of a pixel's noise
};

/// Least squares over the pixels that are not missing.
///
/// missing  NaN where too few pixels, or pixels on too few sides, determine it
[[nodiscard]] PatchFit fit_patch(const Image<float>& image, const Eigen::Vector2i& at);

/// Correlation of what a patch leaves over at neighbouring pixels: of noise it is negative, of an
/// edge or a step positive.
[[nodiscard]] float structure_of(const Image<float>& image,
                                 const Eigen::Vector2i& at,
                                 const WindowFit& patch);

}  // namespace frangia
