#pragma once

#include <cstddef>
#include <vector>

#include "frangia/decode/explain/explain_frames.h"
#include "frangia/pattern/pattern.h"

namespace frangia {

/// The explanation of a pattern by one fault that is decided, by what more than its own frames
/// show. Its classes and odds are left to the caller.
[[nodiscard]] FrameExplanation decided_fault(const Pattern& pattern,
                                             FrameCause cause,
                                             std::vector<std::size_t> frames = {});

}  // namespace frangia
