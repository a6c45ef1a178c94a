#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include <Eigen/Core>

#include "frangia/frames/noise_model.h"
#include "frangia/phase/temporal/check_sequence.h"
#include "frangia/phase/wrap/wrap_phase.h"
#include "frangia/rig/projector.h"

namespace frangia {

/// Sampled pixels of the frames of a pattern, and what the coarser patterns say of these pixels.
struct PredictedFrames {
  Eigen::ArrayXXd counts;     ///< one row per pixel, one column per frame
  Eigen::ArrayXd mean;        ///< counts, of the coarser patterns
  Eigen::ArrayXd modulation;  ///< counts, of the next coarser pattern
  Eigen::ArrayXd phase_rad;   ///< of this pattern, at the place that the coarser ones give
};

/// Predicts the frames of a pattern from those of the coarser ones: three frames
/// determine a phase without a residual, and the prediction gives them one. `map` is the number of
/// the pattern, 1 or more.
///
/// @shape    `coarse_to_fine` as for check_sequence
/// @missing  nothing where the coarser patterns do not determine the place in the field
[[nodiscard]] std::optional<PredictedFrames> predict_frames(
    std::span<const SequenceFrames> coarse_to_fine,
    std::size_t map,
    const NoiseModel& noise,
    const Projector& projector,
    const WrapOptions& wrap = {},
    const SequenceCheckOptions& options = {});

}  // namespace frangia
