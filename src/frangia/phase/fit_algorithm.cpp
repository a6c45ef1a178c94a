#include "frangia/phase/fit_algorithm.h"

#include <algorithm>

#include <fmt/format.h>

#include "frangia/phase/estimate_shifts.h"
#include "frangia/phase/published_algorithms.h"

namespace frangia {
namespace {

/// The residual about equal steps may exceed the noise by this factor, which is known to some 10 %.
constexpr double kMaxExcess = 1.3;

/// The step, unless the frames say that there is no one step: errors that differ from frame to
/// frame would be taken for a gain, and the constant that it adds to the phase be made up.
StepEstimate trusted_step(const FrameStack& stack, const NoiseModel& noise, const Run& run) {
  StepEstimate step = estimate_step(stack);
  const double expected = noise.variance(step.mean_counts);
  if (!step.found || step.residual_counts2 < kMaxExcess * expected) return step;
  step.found = false;
  run.note(
      fmt::format("pattern \"{}\": its steps are not equal ({:.3g} counts squared left, {:.3g} "
                  "expected), so those of scan.toml are used",
                  stack.pattern.name,
                  step.residual_counts2,
                  expected));
  return step;
}

PhaseAlgorithm iterated(const FrameStack& stack, const NoiseModel& noise, const Run& run) {
  static_cast<void>(make_algorithm("aia", stack.pattern.shifts_rad));  // refuses too few frames
  const ShiftEstimate shifts = estimate_shifts(stack, noise);
  if (!shifts.found) {
    run.warn(fmt::format(
        "pattern \"{}\": no set of shifts explains the frames to within their noise ({:.3g} "
        "counts squared left, {:.3g} expected), so the shifts of scan.toml are used",
        stack.pattern.name,
        shifts.residual_counts2,
        shifts.expected_counts2));
  }
  PhaseAlgorithm algorithm = least_squares(shifts.shifts_rad);
  algorithm.name = "aia";
  return algorithm;
}

}  // namespace

FittedAlgorithm fit_algorithm(const std::string& name,
                              const FrameStack& stack,
                              const NoiseModel& noise,
                              const Run& run) {
  const Pattern& pattern = stack.pattern;
  const bool angular = pattern.fringes_per_degree > 0.0;
  const std::string chosen = name == "auto" ? default_algorithm(pattern) : name;
  if (name == "auto") {
    run.note(fmt::format("pattern \"{}\": algorithm {}, for {} frames of {}",
                         pattern.name,
                         chosen,
                         pattern.frame_count(),
                         angular ? "an interferometer" : "a digital projector"));
  }
  if (chosen == "aia") return {iterated(stack, noise, run), {}};
  FittedAlgorithm out;
  if (angular || chosen == "carre" || chosen == "global-carre")
    out.step = trusted_step(stack, noise, run);
  out.algorithm = make_algorithm(chosen, pattern.shifts_rad, out.step.gain_error());
  return out;
}

}  // namespace frangia
