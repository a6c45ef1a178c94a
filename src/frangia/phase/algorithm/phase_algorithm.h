#pragma once

#include <span>
#include <string>
#include <vector>

namespace frangia {

/// A phase-shift algorithm whose coefficients include the shifts of its frames: B sin(phi) = sum
/// sine[k] I_k, B cos(phi) = sum cosine[k] I_k, A = sum mean[k] I_k.
///
/// Every algorithm returns the phase at shift zero, so algorithms can be exchanged without a
/// constant offset.
struct PhaseAlgorithm {
  std::string name;            ///< "4-step", "schwider", ...; see `published_algorithms`
  std::vector<double> sine;    ///< weights of the frames for B sin(phi)
  std::vector<double> cosine;  ///< weights of the frames for B cos(phi)
  std::vector<double> mean;    ///< weights of the frames for A
  /// For Carré's nonlinear algorithm only: with u from `sine` and v from `outer`, B sin(phi +
  /// phase_offset) = sgn(u) sqrt((3u - v)(u + v)). Empty for all other algorithms.
  std::vector<double> outer;
  double phase_offset_rad =
      0.0;  ///< subtracted from the phase at the end; 0 where `outer` is empty
  /// c in sigma_phi = c sigma_I / B, root mean square over phi.
  double noise_gain = 0.0;

  [[nodiscard]] std::size_t frames() const { return sine.size(); }  ///< number of frames
};

/// Returns the phase that an algorithm measures in one pixel's frames, in (-pi, pi].
///
/// @shape    one count per frame
/// @units    counts in, rad out
[[nodiscard]] double phase_of(const PhaseAlgorithm& algorithm, std::span<const double> counts);

/// Returns the least-squares algorithm for arbitrary shifts.
///
/// @units    rad
/// @errors   Error(Input) when fewer than three shifts differ, so that the phase is undetermined
/// @source   Greivenkamp 1984
[[nodiscard]] PhaseAlgorithm least_squares(const std::vector<double>& shifts_rad);

/// Returns a published algorithm for these nominal shifts.
///
/// The actual shifts are `shifts_rad * (1 + gain_error)`. An algorithm measures the phase at the
/// mean shift of its frames, which a gain error moves by `gain_error` times the mean shift; this
/// constant is subtracted.
///
/// @units    rad
/// @errors   Error(Input) for an unknown name, or for shifts that the algorithm does not accept;
///          the message names algorithms that do
[[nodiscard]] PhaseAlgorithm make_algorithm(const std::string& name,
                                            const std::vector<double>& shifts_rad,
                                            double gain_error = 0.0);

/// Changes an algorithm so that it returns a phase smaller by `angle_rad`.
void subtract_phase_offset(double angle_rad, PhaseAlgorithm& algorithm);

}  // namespace frangia
