#pragma once

#include "frangia/frames/frame_stack.h"
#include "frangia/phase/temporal/check_sequence.h"
#include "frangia/phase/wrap/phase_map.h"

namespace frangia {

/// Compares a Gray or binary code with the fringes, and its stripes with their neighbours.
///
/// At the border of two stripes the number changes by one; a frame in another place, inverted or
/// missing breaks this rule at the borders of its stripes. The number also gives the phase of the
/// fringes to within half a stripe. Other orders of the frames, inversions, codes and starts of the
/// fringes are tried.
///
/// @shape    `gray` and `fringes` of one size and direction; one exposure
/// @missing  not decided for too few pixels on which all frames are bright or dark
/// @errors   Error(Input) when the number of frames differs from the pattern
[[nodiscard]] SequenceCheck check_gray_code(const FrameStack& gray,
                                            const WrappedPhase& fringes);

}  // namespace frangia
