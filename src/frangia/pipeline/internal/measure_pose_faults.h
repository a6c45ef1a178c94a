#pragma once

#include <span>

#include "frangia/calibrate/check_board_views.h"
#include "frangia/core/image.h"
#include "frangia/frames/frame_stack.h"
#include "frangia/rig/board.h"

namespace frangia {

/// Measures on the points of a pose, which are found, what faults of the capture show: blur, motion
/// between patterns, and frames that do not fit their pattern.
void measure_pose_faults(std::span<const FrameStack> stacks,
                         const Image<float>& image,
                         const Board& board,
                         PoseCapture& pose);

}  // namespace frangia
