#pragma once

#include <span>

#include "frangia/calibrate/board/board_view.h"
#include "frangia/frames/frame_stack.h"

namespace frangia {

/// How far the frames of a fringe pattern are from a sinusoid of the pattern's shifts: the residual
/// of the fit, as a standard deviation of one frame, relative to the modulation; medians over the
/// bright pixels around the points. 0.01 to 0.03 is camera noise, a display gamma of 2.2 gives 0.3
/// with four frames, and frames in a wrong order give 1.4.
///
/// @missing  NaN for fewer than four frames, which leave no residual, or without bright pixels
[[nodiscard]] double measure_fringe_misfit(const FrameStack& stack,
                                           std::span<const BoardPoint> points);

}  // namespace frangia
