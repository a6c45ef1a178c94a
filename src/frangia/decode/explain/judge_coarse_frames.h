#pragma once

#include <optional>

#include "frangia/decode/explain/judge_frames.h"
#include "frangia/frames/frame_stack.h"
#include "frangia/frames/noise_model.h"

namespace frangia {

/// Finds a lost frame of a pattern that the part covers in less than a fringe, so that its frames
/// by themselves look like those of many causes.
///
/// The other patterns tell mean and modulation of each pixel, which leaves only its phase open: all
/// frames but the lost one agree with them, and the phase that these give is that of the finer
/// pattern. Harmonics of the projector are fitted for all pixels together.
///
/// @shape    a fringe pattern of 3 to 12 frames, at one exposure; `options.references` are the
///           patterns of the view that are as described
/// @missing  nothing without references, for fewer than 200 lit pixels, and where all frames agree
///           or no single one explains what they leave by odds of 100 : 1
[[nodiscard]] std::optional<FrameVerdict> judge_coarse_frames(const FrameStack& stack,
                                                              const NoiseModel& noise,
                                                              const JudgeOptions& options);

}  // namespace frangia
