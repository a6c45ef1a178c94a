#pragma once

#include <span>

#include "frangia/frames/frame_stack.h"
#include "frangia/frames/noise_model.h"
#include "frangia/phase/wrap/estimate_noise.h"

namespace frangia {

/// The noise of several views together, without those whose own noise differs by more than a factor
/// of two in variance from that of most: frames without noise, or of another gain, say nothing
/// about the others.
///
/// @shape    at least one view, all with the same distance
[[nodiscard]] NoiseModel common_noise(std::span<const NoiseSamples> views);

/// The noise of one view: what is known of the others, unless its own frames tell that it differs
/// by more than a factor of two in variance. More noise than known has to be white, since texture
/// and what moved between the frames look like noise otherwise.
///
/// @shape    fringe patterns of three frames or more; others leave what is known
[[nodiscard]] NoiseModel noise_of_view(std::span<const FrameStack> stacks, const NoiseModel& known);

}  // namespace frangia
