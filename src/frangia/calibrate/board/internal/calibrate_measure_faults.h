#pragma once

#include <span>

#include "frangia/calibrate/board/check_board_views.h"
#include "frangia/core/image.h"
#include "frangia/frames/frame_stack.h"
#include "frangia/rig/board.h"

namespace frangia {

/// Measures what faults of a capture show, at the points of `pose`: blur, motion between patterns,
/// patterns that belong to another pose, and frames that do not follow their shifts. `image` is the
/// one in which the points were found.
void calibrate_measure_faults(std::span<const FrameStack> stacks,
                              const Image<float>& image,
                              const Board& board,
                              PoseCapture& pose);

}  // namespace frangia
