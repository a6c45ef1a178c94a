#pragma once

#include <optional>
#include <vector>

#include "frangia/phase/algorithm/phase_algorithm.h"
#include "frangia/phase/wrap/phase_map.h"
#include "frangia/rig/fringe_waveform.h"

namespace frangia {

/// The phase error that a nonlinear projector response causes in an algorithm. It depends on the
/// measured phase only, because the light and the reflectance of a pixel scale all frames alike.
struct ResponseTable {
  /// Correction to add, at evenly spaced phases from -pi to pi inclusive.
  std::vector<float> correction_rad;
};

/// Computes the correction for fringes of full contrast that are shown without a look-up table.
///
/// @errors   Error(Input) when the response is so nonlinear that two phases measure alike
/// @source   Zhang and Yau 2007
[[nodiscard]] ResponseTable response_table(const ResponseCurve& response,
                                           const PhaseAlgorithm& algorithm,
                                           const std::vector<double>& shifts_rad);

/// Computes the correction for a waveform of the fringes.
///
/// @errors   Error(Input) when two phases measure alike
[[nodiscard]] ResponseTable response_table(const FringeWaveform& waveform,
                                           const PhaseAlgorithm& algorithm,
                                           const std::vector<double>& shifts_rad);

/// The same; empty where two phases measure alike.
[[nodiscard]] std::optional<ResponseTable> find_response_table(
    const FringeWaveform& waveform,
    const PhaseAlgorithm& algorithm,
    const std::vector<double>& shifts_rad);

/// Returns the correction at a measured phase.
///
/// @units    rad
[[nodiscard]] double correction_at(const ResponseTable& table, double phase_rad);

/// Corrects a wrapped phase and scales its sigma by the slope of the correction.
///
/// @missing  NaN stays NaN
void correct_response(const ResponseTable& table, WrappedPhase& phase);

}  // namespace frangia
