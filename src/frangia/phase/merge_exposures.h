#pragma once

#include <span>
#include <vector>

#include "frangia/frames/frame_stack.h"
#include "frangia/frames/noise_model.h"
#include "frangia/phase/phase_map.h"
#include "frangia/phase/wrap_phase.h"

namespace frangia {

/// Phase of fringes taken at several exposures: least squares over the unsaturated samples of all
/// of them, each weighted by one over its variance. A highlight is measured by the short exposures,
/// a dark part by the long ones, and what several tell by all; phases are never averaged.
///
/// shape    a stack an exposure, of one pattern; `shifts_rad` as really made
/// units    modulation and mean in counts of the first exposure
/// missing  Saturated where the samples left do not determine the phase, else as `wrap_phase`
/// errors   Error(Input) when empty, or the stacks differ in size or number of frames
[[nodiscard]] WrappedPhase merge_exposures(std::span<const FrameStack> exposures,
                                           const std::vector<double>& shifts_rad,
                                           const NoiseModel& noise,
                                           const WrapOptions& options = {});

}  // namespace frangia
