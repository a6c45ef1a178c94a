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
/// Where the brightness changes: the light of a blurred pixel does not come from
/// its center, but on average from a place that lies s^2 grad(ln B) beside it, with s^2 the
/// variance of the blur and B the modulation. Its phase is therefore off by s^2 grad(ln B) .
/// grad(phase): exactly, for a normal blur and a phase that is linear over it. The slope of the
/// phase is that of a plane through the neighbours on the same surface, without the error that is
/// being corrected. Where the surface bends: the mean over the blur is not the phase of its center.
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
