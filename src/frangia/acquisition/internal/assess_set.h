#pragma once

#include <optional>
#include <span>

#include "frangia/core/run.h"
#include "frangia/frames/frame_stack.h"
#include "frangia/frames/noise_model.h"
#include "frangia/phase/wrap/phase_map.h"

namespace frangia {

/// Motion and step errors of a complete set of fringe frames.
struct SetAssessment {
  bool moved = false;       ///< motion, or flicker of the light, between the frames
  bool step_found = false;  ///< `gain_error` is valid
  double gain_error = 0.0;  ///< true shift = nominal shift * (1 + gain_error)
};

/// Assesses the frames of one pattern. Of several exposures, the one with most measured pixels
/// counts.
///
/// `camera` is the camera's noise model. Without it `moved` is false, because noise estimated from
/// the frames includes motion.
///
/// With n frames it takes at most n^2 operations for each sampled pixel, see `estimate_shifts`; all
/// other steps are linear in pixels and frames.
/// @errors   as fit_algorithm and wrap_phase
[[nodiscard]] SetAssessment assess_set(std::span<const FrameStack> exposures,
                                       const std::optional<NoiseModel>& camera,
                                       bool shifter);

/// Pixel states of the decoded set.
[[nodiscard]] Image<PixelStatus> pixel_status_of(const FrameStack& stack,
                                                 const std::optional<NoiseModel>& camera);

}  // namespace frangia
