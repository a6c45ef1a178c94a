#pragma once

#include <vector>

#include <Eigen/Core>

#include "frangia/frames/frame_stack.h"

namespace frangia {

/// Pixels of a stack for fits over the whole image: about `wanted` of them, evenly over it, none
/// saturated in any frame.
///
/// shape    a row a pixel, a column a frame
[[nodiscard]] Eigen::ArrayXXf sample_frames(const FrameStack& stack, std::size_t wanted);

/// Some rows of a stack, evenly over it, that hold about `wanted` pixels: for a judgement that
/// needs no more.
[[nodiscard]] FrameStack sample_rows(const FrameStack& stack, std::size_t wanted);

}  // namespace frangia
