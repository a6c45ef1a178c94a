#pragma once

#include "frangia/frames/frame_stack.h"
#include "frangia/frames/noise_model.h"
#include "frangia/phase/phase_algorithm.h"
#include "frangia/phase/phase_map.h"

namespace frangia {

struct WrapOptions {
  /// A phase less certain than this is background or shadow: at 0.1 rad the modulation is some ten
  /// times its own noise, and its points would be too coarse to be worth keeping.
  float max_sigma_rad = 0.1F;
};

/// Phase, modulation, mean and expected phase noise of every pixel.
///
/// `recycled` is a map that is no longer needed: of the same size, its memory is written over,
/// since touching new memory for the first time costs more than all the rest. shape    N frames of
/// w x h in, w x h out units    counts in; rad and counts out missing  a pixel that is saturated in
/// any frame, or unmodulated, has no phase and says why errors   Error(Input) when the frames
/// differ in number or size from what the pattern says source   the paper's equation (1) and the
/// algorithm's own
[[nodiscard]] WrappedPhase wrap_phase(const FrameStack& stack,
                                      const PhaseAlgorithm& algorithm,
                                      const NoiseModel& noise,
                                      const WrapOptions& options = {},
                                      WrappedPhase recycled = {});

}  // namespace frangia
