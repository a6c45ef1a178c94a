#pragma once

#include <string>

#include "frangia/frames/frame_stack.h"
#include "frangia/frames/noise_model.h"
#include "frangia/phase/fit_algorithm.h"
#include "frangia/phase/phase_map.h"

namespace frangia {

/// Quality measures of the frames of one pattern.
struct FrameAssessment {
  std::string pattern;
  std::string algorithm;
  double nominal_deg = 0.0;  ///< nominal step; 0 if the step was not estimated
  double step_deg = 0.0;     ///< estimated step
  double step_sigma_deg = 0.0;
  double jitter_deg = 0.0;          ///< rms error of single steps; 0 if none is detected
  double contrast = 0.0;            ///< median of modulation over mean, of the measured pixels
  double measured_fraction = 0.0;   ///< of all pixels
  double saturated_fraction = 0.0;  ///< of all pixels
  /// Residual variance of the fringe fit relative to the camera noise, mean over the measured
  /// pixels. 1 is expected; 0 for three frames, which leave no residual. For four frames 90 degrees
  /// apart the residual is I1 - I2 + I3 - I4.
  double residual_ratio = 0.0;
  /// `residual_ratio` exceeds the limit: the object or the rig moved, or the light flickered,
  /// between the frames.
  bool vibration_suspected = false;
};

/// Assesses the frames of a pattern from its fitted algorithm and wrapped phase.
///
/// shape    `stack` and `map` have the same size
[[nodiscard]] FrameAssessment assess_frames(const FrameStack& stack,
                                            const FittedAlgorithm& fitted,
                                            const WrappedPhase& map,
                                            const NoiseModel& noise);

/// Formats an assessment as one sentence.
[[nodiscard]] std::string describe(const FrameAssessment& assessment);

}  // namespace frangia
