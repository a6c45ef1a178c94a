#pragma once

#include <span>

#include "frangia/frames/frame_stack.h"
#include "frangia/rig/response_curve.h"

namespace frangia {

/// A projector's response from a grey ramp, summed over the pixels that it lights: those whose
/// brightest frame stands well above the darkest, and does not saturate.
///
/// shape    ramps of the same levels, one a view
/// errors   Error(Input) when there is none, when they differ, or when too few pixels are lit
[[nodiscard]] ResponseCurve measure_response(std::span<const FrameStack> ramps);

}  // namespace frangia
