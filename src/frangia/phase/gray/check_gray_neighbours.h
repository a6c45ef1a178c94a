#pragma once

#include "frangia/frames/frame_stack.h"
#include "frangia/phase/temporal/check_sequence.h"

namespace frangia {

/// Compares the numbers of neighbouring stripes of a Gray or binary code without fringes: they
/// differ by one, except at depth edges. Bits in another order, another code, and frames that are
/// exchanged, inverted or without stripes break this rule at the borders of their stripes.
///
/// A declaration that makes nearly all of these borders those of neighbours is named; if several do
/// it alike, all of them are.
///
/// @shape    the frames of one exposure, of one size
/// @missing  not decided for more than 64 frames, or fewer than 300 borders
/// @errors   Error(Input) when the number of frames differs from the pattern
[[nodiscard]] SequenceCheck check_gray_neighbours(const FrameStack& gray);

}  // namespace frangia
