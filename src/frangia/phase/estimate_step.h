#pragma once

#include "frangia/frames/frame_stack.h"

namespace frangia {

/// The step that was really made between the frames, one for the whole image.
struct StepEstimate {
  double nominal_rad = 0.0;  ///< what the pattern asks for
  double step_rad = 0.0;     ///< what the frames show
  double sigma_rad = 0.0;    ///< standard deviation of `step_rad`
  /// Variance of a frame's pixel about equal steps, in counts squared: camera noise, when nothing
  /// moved and nothing clipped.
  double residual_counts2 = 0.0;
  double mean_counts = 0.0;  ///< of the pixels looked at
  /// Error of a single shift that makes the steps unequal, rms; 0 where none shows.
  double jitter_rad = 0.0;
  /// Whether the frames hold enough of a fringe to tell. If not, `step_rad` is the nominal one.
  bool found = false;

  /// The shifts made are those of the pattern times one plus this.
  [[nodiscard]] double gain_error() const { return found ? step_rad / nominal_rad - 1.0 : 0.0; }
};

/// The global Carré: four successive frames of equal steps obey
/// I1 - I4 = (1 + 2 cos step) (I2 - I3) at every pixel, whatever its phase, mean and modulation.
/// Shifts that are off each by itself look like another step too. But they also turn I1 - I4
/// against I2 - I3 by an angle as large as they are, which a wrong step alone does not: the jitter,
/// by which `pooled_gain_error` judges how far the step is the shifter's gain.
///
/// missing  saturated pixels are left out; `found` is false for frames that are too few, not
///          equally spaced, or without fringes
/// source   Carré 1966, the step by total least squares over the image
[[nodiscard]] StepEstimate estimate_step(const FrameStack& stack);

}  // namespace frangia
