#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "frangia/frames/frame_stack.h"
#include "frangia/phase/algorithm/phase_algorithm.h"
#include "frangia/phase/wrap/phase_map.h"
#include "frangia/rig/fringe_waveform.h"

namespace frangia {

/// Least number of frames per fringe. The harmonics of a response then hardly affect the phase.
inline constexpr std::size_t kMinResponseFrames = 6;

/// Measures a projector's response from fringes: the light of every frame against the level that
/// the pixel was shown, which follows from its phase. Well-modulated unsaturated pixels of all
/// stacks contribute.
///
/// @shape    stacks of at least kMinResponseFrames frames with equal steps over a whole turn
/// @errors   Error(Input) when there is no such stack, or when too few pixels are illuminated
[[nodiscard]] ResponseCurve measure_fringe_response(std::span<const FrameStack> stacks);

/// Returns the response whose cosine fringes have this waveform: the harmonics are the coefficients
/// of its Chebyshev series. It serves fringes of few frames, for which `measure_fringe_response` is
/// not possible.
///
/// @errors   Error(Input) when the light at full drive is not above that at none
[[nodiscard]] ResponseCurve response_of_waveform(const FringeWaveform& waveform);

/// Returns whether a pattern has enough shifts, evenly spaced over a turn.
[[nodiscard]] bool determines_response(const Pattern& pattern);

/// Measures a projector's response from a grey ramp, averaged over the illuminated pixels: those
/// with sufficient contrast between the darkest and the brightest frame and without saturation.
///
/// @shape    ramps of the same levels, one per view
/// @errors   Error(Input) when there is no ramp, when the ramps differ, or when too few pixels are
///          illuminated
[[nodiscard]] ResponseCurve measure_response(std::span<const FrameStack> ramps);

/// The phase error that a nonlinear projector response causes in an algorithm. It depends on the
/// measured phase only, because the light and the reflectance of a pixel scale all frames alike.
struct ResponseTable {
  /// Correction to add, at evenly spaced phases from -pi to pi inclusive.
  std::vector<float> correction_rad;
};

/// Computes the correction for fringes of full contrast that are shown without a look-up table.
///
/// @shape    `gains`: those of the frames that the weights of the algorithm compensate; empty for
///           none
/// @errors   Error(Input) when the response is so nonlinear that two phases measure alike
/// @source   Zhang and Yau 2007
[[nodiscard]] ResponseTable response_table(const ResponseCurve& response,
                                           const PhaseAlgorithm& algorithm,
                                           const std::vector<double>& shifts_rad,
                                           std::span<const double> gains = {});

/// Computes the correction for a waveform of the fringes.
///
/// @errors   Error(Input) when two phases measure alike
[[nodiscard]] ResponseTable response_table(const FringeWaveform& waveform,
                                           const PhaseAlgorithm& algorithm,
                                           const std::vector<double>& shifts_rad,
                                           std::span<const double> gains = {});

/// The same; empty where two phases measure alike.
[[nodiscard]] std::optional<ResponseTable> find_response_table(
    const FringeWaveform& waveform,
    const PhaseAlgorithm& algorithm,
    const std::vector<double>& shifts_rad,
    std::span<const double> gains = {});

/// Returns the correction at a measured phase.
///
/// @units    rad
[[nodiscard]] double correction_at(const ResponseTable& table, double phase_rad);

/// Corrects a wrapped phase and scales its sigma by the slope of the correction.
///
/// @missing  NaN stays NaN
void correct_response(const ResponseTable& table, WrappedPhase& phase);

}  // namespace frangia
