#pragma once

#include <cstddef>

#include "frangia/phase/blur/estimate_blur.h"
#include "frangia/phase/wrap/phase_map.h"

namespace frangia {

/// What a correction of the blur changed.
struct BlurCorrection {
  std::size_t pixels = 0;  ///< that were corrected
  double rms_rad = 0.0;    ///< of their corrections
};

/// Corrects a phase for the blur of its image.
///
/// Where the brightness changes, the centroid of the light of a blurred pixel is shifted from the
/// center of the pixel by s^2 grad(ln B), with s^2 the variance of the blur and B the modulation.
/// The phase is therefore off by s^2 grad(ln B) . grad(phase); this is exact for a normal blur and
/// a phase that is linear over it. The gradient of the phase is that of a plane through the
/// neighbours on the same surface, after a first correction. Where the surface is curved, the
/// second derivatives of the phase add s^2 / 2 (tr H - s^2 k . H k), with k its gradient and H its
/// Hessian.
///
/// `modulation_counts` is that of the coarsest fringes of the same direction, which blur weakens
/// least. What the correction may be off enters `systematic_rad`.
/// @shape    images of equal size
/// @units    rad, counts
/// @missing  pixels without a phase stay without one; those beyond the border of a surface, which
///           only blur lets see it, become MixedPixel
/// @source   Burke and Zhong 2017; Rao and Da 2018
BlurCorrection correct_blur(AbsolutePhase& phase,
                            const Image<float>& modulation_counts,
                            const ImageBlur& blur);

}  // namespace frangia
