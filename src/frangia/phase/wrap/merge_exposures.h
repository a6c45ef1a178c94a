#pragma once

#include <span>
#include <vector>

#include "frangia/frames/frame_stack.h"
#include "frangia/frames/noise_model.h"
#include "frangia/phase/wrap/phase_map.h"
#include "frangia/phase/wrap/wrap_phase.h"

namespace frangia {

/// Computes the phase of fringes taken at several exposures by least squares over all unsaturated
/// samples, weighted by their inverse variance. Short exposures measure highlights, long exposures
/// dark parts; phases are never averaged.
///
/// @shape    one stack per exposure, of one pattern; `shifts_rad` are the actual shifts
/// @units    modulation and mean in counts of the first exposure
/// @missing  Saturated where the remaining samples do not determine the phase; otherwise as
///          `wrap_phase`
/// @errors   Error(Input) when empty, or when the stacks differ in size or number of frames
[[nodiscard]] WrappedPhase merge_exposures(std::span<const FrameStack> exposures,
                                           const std::vector<double>& shifts_rad,
                                           const NoiseModel& noise,
                                           const WrapOptions& options = {});

}  // namespace frangia
