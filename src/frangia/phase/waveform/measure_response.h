#pragma once

#include <span>

#include "frangia/frames/frame_stack.h"
#include "frangia/rig/fringe_waveform.h"

namespace frangia {

/// Measures a projector's response from a grey ramp, averaged over the illuminated pixels: those
/// with sufficient contrast between the darkest and the brightest frame and without saturation.
///
/// @shape    ramps of the same levels, one per view
/// @errors   Error(Input) when there is no ramp, when the ramps differ, or when too few pixels are
///          illuminated
[[nodiscard]] ResponseCurve measure_response(std::span<const FrameStack> ramps);

}  // namespace frangia
