#pragma once

#include <vector>

#include "frangia/decode/explain/frame_hypothesis.h"
#include "frangia/decode/explain/internal/frame_sample.h"

namespace frangia {

/// The hypotheses about the frames of a pattern that deserve a score: single faults that fit
/// roughly best, the likeliest lamp, movement and steps, and pairs of the likeliest single faults.
[[nodiscard]] std::vector<FrameHypothesis> likely_hypotheses(const FrameSample& sample,
                                                             const Pattern& pattern);

}  // namespace frangia
