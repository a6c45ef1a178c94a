#pragma once

#include "frangia/frames/frame_stack.h"
#include "frangia/frames/noise_model.h"
#include "frangia/phase/algorithm/phase_algorithm.h"
#include "frangia/phase/wrap/phase_map.h"

namespace frangia {

/// Limit of the phase noise.
struct WrapOptions {
  /// Largest standard deviation of a phase, rad. At 0.1 rad the modulation is about ten times its
  /// noise; pixels above it are background or shadow.
  float max_sigma_rad = 0.1F;
};

/// Computes phase, modulation, mean and phase noise of every pixel.
///
/// `recycled` is a map that is no longer needed; its memory is reused if the size matches, because
/// touching new memory for the first time takes longer than the computation.
///
/// @shape    N frames of w x h in, w x h out
/// @units    counts in; rad and counts out
/// @missing  a pixel that is saturated in any frame, or unmodulated, is NaN; its status states the
///          reason
/// @errors   Error(Input) when number or size of the frames differ from the pattern
/// @source   the paper's equation (1) and the source of the algorithm
[[nodiscard]] WrappedPhase wrap_phase(const FrameStack& stack,
                                      const PhaseAlgorithm& algorithm,
                                      const NoiseModel& noise,
                                      const WrapOptions& options = {},
                                      WrappedPhase recycled = {});

}  // namespace frangia
