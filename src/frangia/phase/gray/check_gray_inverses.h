#pragma once

#include "frangia/frames/frame_stack.h"
#include "frangia/phase/temporal/sequence_check.h"

namespace frangia {

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
