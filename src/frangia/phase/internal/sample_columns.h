#pragma once

#include <cstddef>

#include "frangia/frames/frame_stack.h"

namespace frangia {

/// Samples evenly spaced columns that hold about `wanted` pixels, as the rows of the result: a row
/// then runs across horizontal fringes.
[[nodiscard]] FrameStack sample_columns(const FrameStack& stack, std::size_t wanted);

}  // namespace frangia
