#pragma once

#include "frangia/frames/frame_stack.h"

namespace frangia {

/// The actual step between the frames, one for the whole image.
struct StepEstimate {
  double nominal_rad = 0.0;  ///< nominal step of the pattern
  double step_rad = 0.0;     ///< estimated step; nominal unless `found`
  double sigma_rad = 0.0;    ///< standard deviation of `step_rad`
  /// Residual variance of a pixel about equal steps, in counts squared; camera noise if nothing
  /// moved or clipped.
  double residual_counts2 = 0.0;
  double mean_counts = 0.0;  ///< mean of the sampled pixels
  /// Rms error of single shifts; 0 if none is detected.
  double jitter_rad = 0.0;
  /// Whether the fringes determine the step. If not, `step_rad` is the nominal step.
  bool found = false;

  /// Relative error of the shifts: actual = nominal * (1 + gain_error).
  [[nodiscard]] double gain_error() const { return found ? step_rad / nominal_rad - 1.0 : 0.0; }
};

/// Estimates the step by global Carré: four successive frames of equal steps satisfy I1 - I4 = (1 +
/// 2 cos step) (I2 - I3) at every pixel, for any phase, mean and modulation. Independent errors of
/// the shifts also change the apparent step. In addition they shift the phase of I1 - I4 relative
/// to I2 - I3 by an angle of their own size, which a wrong common step does not. This jitter lets
/// `pooled_gain_error` decide how much of the step error is the gain of the shifter.
///
/// Harmonics of the fringes also change the apparent step. Where harmonics at the nominal steps
/// explain the frames better than a sine at the estimated step, six frames or more determine the
/// step together with harmonics of each pixel; for fewer frames the nominal steps stand.
///
/// @missing  saturated pixels are ignored; `found` is false for fewer than four frames, unequal
///          nominal steps, or too weak fringes
/// @source   Carré 1966; the step by total least squares over the image
[[nodiscard]] StepEstimate estimate_step(const FrameStack& stack);

}  // namespace frangia
