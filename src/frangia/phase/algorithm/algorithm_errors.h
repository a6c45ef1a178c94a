#pragma once

#include <vector>

#include "frangia/phase/algorithm/phase_algorithm.h"

namespace frangia {

/// The sensitivity of an algorithm to imperfect frames, measured on synthetic frames.
struct AlgorithmErrors {
  double ripple_rad =
      0.0;  ///< peak-to-valley error over a fringe, mean of a step 5 % too long and 5 % too short
  double noise_gain = 0.0;       ///< c in sigma_phi = c sigma_I / B, rms over phi
  double second_harmonic = 0.0;  ///< largest phase error per unit harmonic amplitude relative to B
  double third_harmonic = 0.0;   ///< the same for the third harmonic
};

/// Measures the sensitivity of `algorithm` at these shifts. With `step_known` the algorithm uses
/// the true step, as global Carré does after estimating it.
[[nodiscard]] AlgorithmErrors algorithm_errors(const PhaseAlgorithm& algorithm,
                                               const std::vector<double>& shifts_rad,
                                               bool step_known = false);

/// Returns c in sigma_phi = c sigma_I / B, root mean square over phi.
[[nodiscard]] double noise_gain(const PhaseAlgorithm& algorithm,
                                const std::vector<double>& shifts_rad);

/// Returns the peak-to-valley phase error over a fringe when every shift is too long by the
/// fraction `error`.
///
/// @units    rad
[[nodiscard]] double ripple(const PhaseAlgorithm& algorithm,
                            const std::vector<double>& shifts_rad,
                            double error);

}  // namespace frangia
