#pragma once

#include <optional>
#include <span>

#include "frangia/core/run.h"
#include "frangia/frames/frame_stack.h"
#include "frangia/frames/noise_model.h"
#include "frangia/phase/phase_map.h"

namespace frangia {

/// What a complete set of fringes tells the session that took it.
struct SetAssessment {
  bool moved = false;       ///< something moved, or the light flickered, between its frames
  bool step_found = false;  ///< the frames tell how long the shifts really were
  double gain_error = 0.0;  ///< the shifts made are those of the pattern times one plus this
};

/// Assesses the frames of one pattern, at all its exposures: the best exposed ones speak for it.
///
/// `camera` is the noise of the camera itself: noise that is estimated from the frames would hide
/// motion; without it nothing counts as moved.
/// errors   as fit_algorithm and wrap_phase
[[nodiscard]] SetAssessment assess_set(std::span<const FrameStack> exposures,
                                       const std::optional<NoiseModel>& camera,
                                       bool shifter);

/// What becomes of each pixel when this set is decoded.
[[nodiscard]] Image<PixelStatus> pixel_status_of(const FrameStack& stack,
                                                 const std::optional<NoiseModel>& camera);

}  // namespace frangia
