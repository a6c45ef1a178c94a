#pragma once

#include <span>

#include "frangia/core/image.h"
#include "frangia/frames/frame_stack.h"
#include "frangia/frames/noise_model.h"
#include "frangia/phase/temporal/unwrap_temporally.h"
#include "frangia/phase/wrap/phase_map.h"

namespace frangia {

/// Limits of `decode_gray_alone`.
struct GrayAloneOptions {
  /// Difference of bright and dark over its standard deviation below which a pixel is unlit.
  double min_contrast = 8.0;
  /// Probability that a bit is misread by which the stripe would change by more than one.
  double max_wrong_stripe = TemporalUnwrapOptions{}.max_wrong_order;
};

/// Computes the projector's column (or row) at each pixel from a Gray or binary code without
/// fringes, as the phase of one fringe that is as long as the code.
///
/// Each bit is the comparison of a frame with its inverse, or with `threshold_counts`. Along an
/// image row (or column), the border of two neighbouring stripes lies where the difference crosses
/// zero, between two pixels. The columns of the pixels between the two borders of a stripe are
/// interpolated, with the curvature that the next borders show. A stripe with one border continues
/// the rate of its neighbour; one without borders gives the column of its centre.
///
/// Stripes that the camera does not resolve are left out: without its last bits, the code is that
/// of wider stripes.
///
/// The standard deviation counts the camera's noise at the borders, the error of the interpolation
/// (where pixels are fully bright or dark on both sides of most borders, a uniform distribution
/// over a pixel), a fifth of the distance from a single border, and for a stripe without borders
/// its width (a uniform distribution over it). Neighbouring pixels share their borders, so that the
/// mean of many pixels does not remove these errors: half of their variance counts as systematic.
///
/// @shape    `gray` has one stack per exposure; `threshold_counts` at the first exposure, empty for
///           a code with inverted frames
/// @units    rad; `phase` = 2 pi column / (stripe_px 2^bits)
/// @missing  NaN where no bit has contrast or a bit is uncertain; `status` states the reason
/// @errors   Error(Input) for a wrong number of frames or bits, or without threshold and inverses
/// @source   zero crossings of the difference: Trobina 1995; Moreno and Taubin 2012
[[nodiscard]] AbsolutePhase decode_gray_alone(std::span<const FrameStack> gray,
                                              const Image<float>& threshold_counts,
                                              const NoiseModel& noise,
                                              const GrayAloneOptions& options = {});

/// Returns the counts halfway between bright and dark at each pixel: the mean of a white and an
/// ambient frame where both are given (not null), or else of the brightest and the darkest frame of
/// the code.
///
/// @missing  NaN where these two differ much less than at a neighbouring pixel
[[nodiscard]] Image<float> gray_threshold(const FrameStack& gray,
                                          const FrameStack* white,
                                          const FrameStack* ambient);

/// Estimates the camera's noise from the frames of a Gray code. A frame and its inverse sum up to
/// the same light for each bit; without inverses, second differences along the rows are used, whose
/// median the borders of the stripes do not change.
///
/// @units    counts
/// @missing  with too few pixels the model is quantization noise
[[nodiscard]] NoiseModel estimate_gray_noise(const FrameStack& gray);

}  // namespace frangia
