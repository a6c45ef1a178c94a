#pragma once

#include <string>
#include <vector>

#include "frangia/phase/algorithm/phase_algorithm.h"

namespace frangia {

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

}  // namespace frangia
