#pragma once

#include <string>

#include "frangia/frames/frame_stack.h"
#include "frangia/frames/noise_model.h"
#include "frangia/phase/fit_algorithm.h"
#include "frangia/phase/phase_map.h"

namespace frangia {

/// How good the frames of one pattern are, in numbers.
struct FrameAssessment {
  std::string pattern;
  std::string algorithm;
  double nominal_deg = 0.0;  ///< step asked for; 0 when it was not looked at
  double step_deg = 0.0;     ///< step found
  double step_sigma_deg = 0.0;
  double jitter_deg = 0.0;          ///< how uneven the steps are, rms; 0 where it does not show
  double contrast = 0.0;            ///< median of modulation over mean, of the measured pixels
  double measured_fraction = 0.0;   ///< of all pixels
  double saturated_fraction = 0.0;  ///< of all pixels
  /// Variance that no phase explains, over that of the camera's noise, of the pixels used; 0 when
  /// three frames leave nothing over. At four 90 degree steps this is I1 - I2 + I3 - I4.
  double residual_ratio = 0.0;
  /// The residual is too large for noise: something moved, or the light flickered, between frames.
  bool vibration_suspected = false;
};

/// Judges the frames of a pattern from what its decoding found.
[[nodiscard]] FrameAssessment assess_frames(const FrameStack& stack,
                                            const FittedAlgorithm& fitted,
                                            const WrappedPhase& map,
                                            const NoiseModel& noise);

/// The assessment as one sentence.
[[nodiscard]] std::string describe(const FrameAssessment& assessment);

}  // namespace frangia
