#pragma once

#include <string>
#include <vector>

#include "frangia/pattern/pattern.h"

namespace frangia {

/// A phase-shift algorithm that is linear in the frames:
/// B sin(phi) = sum sine[k] I_k,  B cos(phi) = sum cosine[k] I_k,  A = sum mean[k] I_k.
/// The shifts of the frames are already in the coefficients.
struct PhaseAlgorithm {
  std::string name;
  std::vector<double> sine;
  std::vector<double> cosine;
  std::vector<double> mean;

  /// c of sigma_phi = c sigma_I / B, root mean square over phi.
  [[nodiscard]] double noise_gain() const;
};

/// Least squares for any list of shifts that determines the phase.
///
/// errors   Error(Input) when fewer than three shifts differ, so that the phase is not determined
/// source   Greivenkamp 1984
[[nodiscard]] PhaseAlgorithm least_squares(const std::vector<double>& shifts_rad);

/// The four-frame algorithm that compensates errors of the step.
///
/// errors   Error(Input) unless there are four shifts 90 degrees apart, rising or falling
/// source   Schwider et al. 1993, reference [33] of the paper
[[nodiscard]] PhaseAlgorithm schwider(const std::vector<double>& shifts_rad);

/// The algorithm by its name, "least-squares" or "schwider"; for "auto" Schwider's for an angular
/// projector with four 90 degree steps, least squares otherwise (it keeps even harmonics out, which
/// a display's response makes).
///
/// errors   Error(Input) for an unknown name, or shifts that do not fit
[[nodiscard]] PhaseAlgorithm choose_algorithm(const std::string& name, const Pattern& pattern);

}  // namespace frangia
