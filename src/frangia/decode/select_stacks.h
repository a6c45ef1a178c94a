#pragma once

#include <span>
#include <vector>

#include "frangia/frames/frame_stack.h"
#include "frangia/pattern/pattern.h"

namespace frangia {

/// Returns the fringe patterns of one direction, coarse to fine, each at its first exposure.
[[nodiscard]] std::vector<const FrameStack*> fringes_of(std::span<const FrameStack> stacks,
                                                        FringeDirection direction);

/// Returns the frame of the laser sheet; null if the scan has none.
[[nodiscard]] const FrameStack* line_of(std::span<const FrameStack> stacks);

/// Returns the stacks of all exposures of a pattern; `stack` is the first.
[[nodiscard]] std::span<const FrameStack> exposures_of(const FrameStack* stack);

/// Whether a pattern was captured at several exposures.
[[nodiscard]] bool are_bracketed(std::span<const FrameStack> stacks);

/// Returns the Gray code in a direction, at all exposures; empty if the scan has none.
[[nodiscard]] std::span<const FrameStack> gray_of(std::span<const FrameStack> stacks,
                                                  FringeDirection direction);

/// Returns the patterns that some stacks show, each once.
[[nodiscard]] std::vector<Pattern> patterns_of(std::span<const FrameStack> stacks);

}  // namespace frangia
