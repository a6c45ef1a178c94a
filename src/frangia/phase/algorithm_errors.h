#pragma once

#include <vector>

#include "frangia/phase/phase_algorithm.h"

namespace frangia {

/// What an algorithm makes of imperfect frames, found by feeding it such frames.
struct AlgorithmErrors {
  double ripple_rad = 0.0;  ///< peak to valley over a fringe, mean of a step 5 % long and short
  double noise_gain = 0.0;  ///< c of sigma_phi = c sigma_I / B, rms over phi
  double second_harmonic = 0.0;  ///< largest phase error, over the harmonic's share of B
  double third_harmonic = 0.0;
};

/// `step_known` says that the algorithm is told the true step, as the global Carré finds it.
[[nodiscard]] AlgorithmErrors algorithm_errors(const PhaseAlgorithm& algorithm,
                                               const std::vector<double>& shifts_rad,
                                               bool step_known = false);

/// c of sigma_phi = c sigma_I / B, root mean square over phi.
[[nodiscard]] double noise_gain(const PhaseAlgorithm& algorithm,
                                const std::vector<double>& shifts_rad);

/// Peak-to-valley phase error over a fringe when every shift is `error` of itself too long.
[[nodiscard]] double ripple(const PhaseAlgorithm& algorithm,
                            const std::vector<double>& shifts_rad,
                            double error);

}  // namespace frangia
