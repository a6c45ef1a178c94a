#pragma once

#include <Eigen/Core>

#include "frangia/frames/frame_stack.h"

namespace frangia {

/// The step of fringes that have harmonics.
struct HarmonicStep {
  /// Harmonics at the nominal step explain the frames better than a sine at the estimated step.
  bool harmonics = false;
  bool found = false;      ///< six frames or more determine the step in spite of the harmonics
  double step_rad = 0.0;   ///< valid if `found`
  double sigma_rad = 0.0;  ///< standard deviation of `step_rad`
};

/// Compares the evidence for a wrong step `step_rad` with that for harmonics at the nominal step.
/// With harmonics, it estimates the step for which a mean and several free harmonics of each pixel
/// leave the least residual.
///
/// @shape    `counts` one row per pixel, one column per frame
[[nodiscard]] HarmonicStep find_harmonic_step(const FrameStack& stack,
                                              const Eigen::ArrayXXf& counts,
                                              double nominal_rad,
                                              double step_rad);

}  // namespace frangia
