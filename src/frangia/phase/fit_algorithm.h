#pragma once

#include <optional>
#include <string>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/frames/frame_stack.h"
#include "frangia/frames/noise_model.h"
#include "frangia/phase/estimate_step.h"
#include "frangia/phase/phase_algorithm.h"

namespace frangia {

/// The algorithm for the frames at hand, and the step that they show.
struct FittedAlgorithm {
  PhaseAlgorithm algorithm;
  StepEstimate step;
  double gain_error = 0.0;         ///< of the phase shifter, as the algorithm takes it
  std::vector<double> shifts_rad;  ///< of the frames, as really made
};

/// An algorithm by its name, or for "auto" the one that suits the projector and the frames.
///
/// A phase shifter's steps are as long as the frames say, and the constant that its gain adds to
/// the phase is taken off: `gain_error`, where it is known from all views, or what these frames
/// alone say of it. A digital projector's shifts are exact and not looked at, but for
/// "global-carre", "carre" and "aia", which ask for it.
/// errors   Error(Input) for an unknown name, or shifts that do not fit, naming those that do
[[nodiscard]] FittedAlgorithm fit_algorithm(const std::string& name,
                                            const FrameStack& stack,
                                            const NoiseModel& noise,
                                            const Run& run = {},
                                            std::optional<double> gain_error = {});

}  // namespace frangia
