#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "frangia/core/run.h"

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

/// Changes an algorithm so that it measures frames of which the light of the projector has a gain
/// of 1 + gains[k]. The rest of their mean, `steady_share` of it, has none.
///
/// @shape    one relative gain per frame, with these shifts; empty for none
void compensate_gains(std::span<const double> gains,
                      double steady_share,
                      const std::vector<double>& shifts_rad,
                      PhaseAlgorithm& algorithm);

/// An algorithm and the frames for which it was made.
struct LinearAlgorithm {
  PhaseAlgorithm algorithm;        ///< its coefficients include the shifts
  std::vector<double> shifts_rad;  ///< that the frames must have
};

/// The algorithm phi = atan2(sum numerator[k] I_k, sum denominator[k] I_k) for frames with these
/// shifts, A + B cos(phi + shifts_rad[k]).
///
/// A common factor of the coefficients and a constant angle of the result are taken off, so that it
/// returns the phase at shift zero like every other algorithm.
///
/// @units    rad
/// @errors   Error(Input) when the numbers of coefficients differ, when the shifts do not determine
///           a phase, or when the result would depend on A, vary with the phase in another way, or
///           have the opposite sign
/// @source   Freischlad and Koliopoulos 1990: the two sums are one complex filter of the frames
[[nodiscard]] LinearAlgorithm linear_algorithm(const std::string& name,
                                               const std::vector<double>& shifts_rad,
                                               const std::vector<double>& numerator,
                                               const std::vector<double>& denominator);

/// Whether frames with these shifts are those for which the algorithm was made, up to whole turns.
[[nodiscard]] bool fits(const LinearAlgorithm& algorithm, const std::vector<double>& shifts_rad);

/// Reads a phase-shift algorithm of the user:
///
///     format = "frangia-algorithm"
///     version = 1
///     name = "mine"
///     shifts_deg = [0, 90, 180, 270]
///     numerator = [0, -1, 0, 1]          # phase = atan2(numerator . frames, denominator . frames)
///     denominator = [1, 0, -1, 0]
///
/// @errors   Error(Input) that names the file and the key, and as `linear_algorithm`
[[nodiscard]] LinearAlgorithm read_algorithm(const std::filesystem::path& path,
                                             const Run& run = {});

}  // namespace frangia
