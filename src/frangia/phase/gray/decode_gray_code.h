#pragma once

#include <span>

#include "frangia/frames/frame_stack.h"
#include "frangia/frames/noise_model.h"
#include "frangia/phase/temporal/unwrap_temporally.h"
#include "frangia/phase/wrap/phase_map.h"

namespace frangia {

/// Computes the absolute phase of fringes whose orders a Gray code gives.
///
/// Each bit is the comparison of a frame with its inverse, or with the mean of the fringes. The
/// stripe only has to lie within half a fringe of the phase. With stripes half a fringe wide,
/// misreading a stripe as its neighbour therefore does not change the order. The probability of a
/// wrong order sums, over the bits that would change the order, the probability that the bit is
/// misread, and adds the probability that the phase is wrong by the remaining margin.
///
/// @shape    `gray` has one stack per exposure; all frames w x h as `fringes`
/// @missing  a pixel missing in `fringes`, or whose probability of a wrong order exceeds
///          `options.max_wrong_order`, is NaN; its status states the reason
/// @errors   Error(Input) when stripes are wider than a fringe, or when size or direction differ
/// @source   Sansoni, Carocci and Rodella 1999 for the stripes of half a fringe
[[nodiscard]] AbsolutePhase decode_gray_code(std::span<const FrameStack> gray,
                                             const WrappedPhase& fringes,
                                             const NoiseModel& noise,
                                             const TemporalUnwrapOptions& options = {});

}  // namespace frangia
