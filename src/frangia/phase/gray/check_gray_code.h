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
[[nodiscard]] SequenceCheck check_gray_code(const FrameStack& gray, const WrappedPhase& fringes);

/// Compares each frame of a Gray or binary code with its inverse: both together show the light of
/// the bright and of the dark stripes, alike for all bits. A frame that is lost, repeated, late,
/// exchanged or inverted does not.
///
/// @shape    the frames of one exposure, of one size
/// @missing  not decided for a code without inverted frames, for fewer than three bits and where
///           hardly any pixel is lit
/// @errors   Error(Input) when the number of frames differs from the pattern
[[nodiscard]] SequenceCheck check_gray_inverses(const FrameStack& gray);

}  // namespace frangia
