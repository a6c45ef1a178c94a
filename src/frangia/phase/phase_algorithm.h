#pragma once

#include <span>
#include <string>
#include <vector>

namespace frangia {

/// A phase-shift algorithm with the shifts of its frames already in its coefficients:
/// B sin(phi) = sum sine[k] I_k,  B cos(phi) = sum cosine[k] I_k,  A = sum mean[k] I_k.
///
/// The phase is that at shift zero, whatever the algorithm: swapping them leaves no constant.
struct PhaseAlgorithm {
  std::string name;
  std::vector<double> sine;
  std::vector<double> cosine;
  std::vector<double> mean;
  /// Carré's alone, which is not linear: with u of `sine` and v of `outer`,
  /// B sin(phi + turn) = sgn(u) sqrt((3u - v)(u + v)). Empty for all others.
  std::vector<double> outer;
  double phase_offset_rad = 0.0;  ///< taken off the phase at the end; 0 where `outer` is empty
  /// c of sigma_phi = c sigma_I / B, root mean square over phi.
  double noise_gain = 0.0;

  [[nodiscard]] std::size_t frames() const { return sine.size(); }
};

/// The phase that an algorithm finds in the frames of one pixel, in (-pi, pi].
[[nodiscard]] double phase_of(const PhaseAlgorithm& algorithm, std::span<const double> counts);

/// Least squares for any list of shifts that determines the phase.
///
/// errors   Error(Input) when fewer than three shifts differ, so that the phase is not determined
/// source   Greivenkamp 1984
[[nodiscard]] PhaseAlgorithm least_squares(const std::vector<double>& shifts_rad);

/// A published algorithm for these shifts.
///
/// `gain_error` says that the shifts really made are `shifts_rad * (1 + gain_error)`. An algorithm
/// finds the phase in the middle of its frames, which then lies `gain_error` times their mean shift
/// from where it should: that constant is taken off.
/// errors   Error(Input) for an unknown name, or shifts that do not fit, naming those that do
[[nodiscard]] PhaseAlgorithm make_algorithm(const std::string& name,
                                            const std::vector<double>& shifts_rad,
                                            double gain_error = 0.0);

/// Takes `angle_rad` off the phase that the algorithm finds.
void subtract_phase_offset(double angle_rad, PhaseAlgorithm& algorithm);

}  // namespace frangia
