#pragma once

#include <cstddef>
#include <span>

#include "frangia/frames/frame_stack.h"
#include "frangia/rig/fringe_waveform.h"

namespace frangia {

/// Least number of frames per fringe. The harmonics of a response then hardly affect the phase.
inline constexpr std::size_t kMinResponseFrames = 6;

/// Measures a projector's response from fringes: the light of every frame against the level that
/// the pixel was shown, which follows from its phase. Well-modulated unsaturated pixels of all
/// stacks contribute.
///
/// @shape    stacks of at least kMinResponseFrames frames with equal steps over a whole turn
/// @errors   Error(Input) when there is no such stack, or when too few pixels are illuminated
[[nodiscard]] ResponseCurve measure_fringe_response(std::span<const FrameStack> stacks);

/// Returns the response whose cosine fringes have this waveform: the harmonics are the coefficients
/// of its Chebyshev series. It serves fringes of few frames, for which `measure_fringe_response` is
/// not possible.
///
/// @errors   Error(Input) when the light at full drive is not above that at none
[[nodiscard]] ResponseCurve response_of_waveform(const FringeWaveform& waveform);

/// Returns whether a pattern has enough shifts, evenly spaced over a turn.
[[nodiscard]] bool determines_response(const Pattern& pattern);

}  // namespace frangia
