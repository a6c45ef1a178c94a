#pragma once

#include <span>

#include "frangia/core/image.h"
#include "frangia/frames/frame_stack.h"

namespace frangia {

/// Image of a board without fringes: the frame of kind "white" where the scan has one, otherwise
/// the mean intensity of the fringe frames.
///
/// The frames of a pattern are weighted so that fringes of any shifts cancel.
/// @shape    size of the frames
/// @units    counts
/// @errors   Error(Input) when there is neither a white frame nor a fringe pattern
[[nodiscard]] Image<float> board_image(std::span<const FrameStack> stacks);

}  // namespace frangia
