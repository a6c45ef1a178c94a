#pragma once

#include <optional>
#include <string>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/frames/frame_stack.h"
#include "frangia/frames/noise_model.h"
#include "frangia/phase/algorithm/estimate_step.h"
#include "frangia/phase/algorithm/phase_algorithm.h"
#include "frangia/phase/waveform/fit_waveform.h"

namespace frangia {

/// The algorithm for the given frames and the step that they show.
struct FittedAlgorithm {
  PhaseAlgorithm algorithm;        ///< its coefficients include the estimated shifts
  StepEstimate step;               ///< step that the frames show
  double gain_error = 0.0;         ///< gain error of the phase shifter that `algorithm` assumes
  std::vector<double> shifts_rad;  ///< actual shifts of the frames
  /// Harmonics of the fringes and flicker. `algorithm` compensates its gains.
  WaveformFit waveform;
  /// Standard uncertainty of the phase by what nothing explains in the frames.
  ///
  /// @units    rad
  double unexplained_rad = 0.0;
};

/// Returns the algorithm `name`, or for "auto" the one that suits the projector and the number of
/// frames.
///
/// For a phase shifter the step is estimated from the frames, and the constant phase that a gain
/// error adds is subtracted. `gain_error` is the gain error pooled over all views; without it the
/// frames alone determine it. The shifts of a digital projector are exact and are estimated only
/// for "global-carre", "carre" and "aia". Harmonics of the fringes are fitted, and the weights of
/// the frames compensate flicker that the frames determine.
///
/// @errors   Error(Input) for an unknown name, or for shifts that the algorithm does not accept;
///          the message names algorithms that do
[[nodiscard]] FittedAlgorithm fit_algorithm(const std::string& name,
                                            const FrameStack& stack,
                                            const NoiseModel& noise,
                                            const Run& run = {},
                                            std::optional<double> gain_error = {});

/// Returns an algorithm of the user with what the frames show: harmonics, and flicker, which its
/// weights compensate. Its shifts are taken as exact.
///
/// @errors   Error(Input) when the frames have other shifts than the algorithm
[[nodiscard]] FittedAlgorithm fit_algorithm(const LinearAlgorithm& own,
                                            const FrameStack& stack,
                                            const NoiseModel& noise);

}  // namespace frangia
