#pragma once

#include <vector>

#include "frangia/phase/phase_algorithm.h"
#include "frangia/phase/phase_map.h"
#include "frangia/rig/response_curve.h"

namespace frangia {

/// What a projector that is not linear adds to the phase that an algorithm finds. It depends on
/// that phase alone: the light and the reflectance of a pixel scale all frames alike.
struct ResponseTable {
  /// rad, to be added; at evenly spaced phases from -pi to pi, both ends.
  std::vector<float> correction_rad;
};

/// The table of fringes of full contrast shown without a look-up table.
///
/// errors   Error(Input) when the response is so bent that two phases look alike
/// source   Zhang and Yau 2007
[[nodiscard]] ResponseTable response_table(const ResponseCurve& response,
                                           const PhaseAlgorithm& algorithm,
                                           const std::vector<double>& shifts_rad);

/// Takes the projector's response off a wrapped phase, and what it stretches off its sigma.
void correct_response(const ResponseTable& table, WrappedPhase& phase);

}  // namespace frangia
