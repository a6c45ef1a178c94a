#pragma once

#include <cstddef>
#include <span>

#include "frangia/frames/frame_stack.h"
#include "frangia/rig/response_curve.h"

namespace frangia {

/// Frames a fringe from which its shape is known: the harmonics that a response makes then hardly
/// reach the phase.
inline constexpr std::size_t kMinResponseFrames = 6;

/// A projector's response from the fringes themselves: the light of every frame against the level
/// that the pixel was shown, which its phase tells, summed over all well-modulated pixels that do
/// not saturate.
///
/// shape    stacks of kMinResponseFrames frames or more, of equal steps over a whole turn
/// errors   Error(Input) when there is none, or when too few pixels are lit
[[nodiscard]] ResponseCurve measure_fringe_response(std::span<const FrameStack> stacks);

/// Whether the shifts of a pattern are evenly spread over a turn, and enough.
[[nodiscard]] bool determines_response(const Pattern& pattern);

}  // namespace frangia
