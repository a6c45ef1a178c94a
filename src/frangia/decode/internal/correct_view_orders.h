#pragma once

#include <span>

#include "frangia/core/run.h"
#include "frangia/decode/decode_view.h"
#include "frangia/frames/frame_stack.h"
#include "frangia/phase/algorithm/fit_algorithm.h"

namespace frangia {

/// Corrects regions of a wrong fringe order. The wrapped maps may be gone, so the coarse phases are
/// computed again at the few pixels that matter; a correction of the projector's response is not
/// repeated, as it is far smaller than half a fringe.
void correct_view_orders(std::span<const FrameStack* const> fringes,
                         std::span<const FittedAlgorithm> fits,
                         const DecodeOptions& options,
                         const Run& run,
                         DecodedDirection& out);

}  // namespace frangia
