#pragma once

#include <span>
#include <string>

#include "frangia/core/image.h"
#include "frangia/frames/frame_stack.h"
#include "frangia/phase/wrap/phase_map.h"

namespace frangia {

/// Explains why no pixel of a view has a phase, and what to do: saturated frames, dark frames, or
/// frames without fringes.
///
/// @shape    `status` of the view that was decoded from `stacks`, or empty
/// @missing  empty where a pixel has a phase, or without frames
[[nodiscard]] std::string explain_no_phase(std::span<const FrameStack> stacks,
                                           const Image<PixelStatus>& status);

}  // namespace frangia
