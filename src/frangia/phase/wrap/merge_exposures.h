#pragma once

#include <cstddef>
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

/// Reconstructs single saturated counts. Four frames 90 degrees apart satisfy I1 + I3 = I2 + I4, so
/// three frames determine the fourth. The frames become 16 bits deep, because recovered counts
/// exceed the white level. A pixel with more than one saturated frame stays saturated. Returns the
/// number of recovered pixels.
///
/// The noise of a recovered count is that of three frames; sigma of such a pixel is up to twice the
/// reported value.
/// @errors   Error(Input) unless there are four shifts 90 degrees apart
std::size_t recover_saturated(FrameStack& stack);

}  // namespace frangia
