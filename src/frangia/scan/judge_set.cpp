#include "frangia/scan/judge_set.h"

#include <algorithm>
#include <cmath>

#include "frangia/phase/estimate_noise.h"
#include "frangia/phase/estimate_shifts.h"
#include "frangia/phase/estimate_step.h"
#include "frangia/phase/fit_algorithm.h"
#include "frangia/phase/judge_frames.h"
#include "frangia/phase/wrap_phase.h"

namespace frangia {
namespace {

/// A piezo that is a degree off, now and then, does not shake: more than this must be left over.
constexpr double kShakenPiezo = 6.0;
/// A step that is farther off was not found rightly: a fringe too few, something in the way.
constexpr double kBelievable = 0.3;

NoiseModel noise_of(const FrameStack& stack, const std::optional<NoiseModel>& camera) {
  return camera ? *camera : estimate_noise({&stack, 1});
}

/// How much longer than asked for the shifts are, by all of them where there are enough.
void find_gain(const FrameStack& stack, const NoiseModel& noise, SetVerdict& verdict) {
  const std::vector<double>& asked = stack.pattern.shifts_rad;
  if (asked.size() >= 6) {
    const ShiftEstimate shifts = estimate_shifts(stack, noise);
    double across = 0.0;
    double square = 0.0;
    double mean_asked = 0.0;
    double mean_found = 0.0;
    const auto count = static_cast<double>(asked.size());
    for (std::size_t i = 0; i < asked.size(); ++i) {
      mean_asked += asked[i] / count;
      mean_found += shifts.shifts_rad[i] / count;
    }
    for (std::size_t i = 0; i < asked.size(); ++i) {
      across += (asked[i] - mean_asked) * (shifts.shifts_rad[i] - mean_found);
      square += (asked[i] - mean_asked) * (asked[i] - mean_asked);
    }
    verdict.step_found = shifts.found;
    verdict.gain_error = across / square - 1.0;
  } else {
    const StepEstimate step = estimate_step(stack);
    verdict.step_found = step.found;
    verdict.gain_error = step.gain_error();
  }
  verdict.step_found = verdict.step_found && std::abs(verdict.gain_error) < kBelievable;
}

}  // namespace

SetVerdict judge_set(std::span<const FrameStack> exposures,
                     const std::optional<NoiseModel>& camera,
                     bool shifter) {
  SetVerdict verdict;
  double best_share = -1.0;
  const FrameStack* best = nullptr;
  FrameVerdict spoken;
  for (const FrameStack& stack : exposures) {
    const NoiseModel noise = noise_of(stack, camera);
    const FittedAlgorithm fitted = fit_algorithm("auto", stack, noise);
    const FrameVerdict judged =
        judge_frames(stack, fitted, wrap_phase(stack, fitted.algorithm, noise), noise);
    if (judged.measured_share <= best_share) continue;
    best_share = judged.measured_share;
    best = &stack;
    spoken = judged;
  }
  if (best == nullptr) return verdict;
  const bool shaken = shifter ? spoken.residual_ratio > kShakenPiezo : spoken.vibration_suspected;
  if (shifter) find_gain(*best, noise_of(*best, camera), verdict);
  verdict.moved = camera && shaken;
  return verdict;
}

Image<PixelFate> fate_of(const FrameStack& stack, const std::optional<NoiseModel>& camera) {
  const NoiseModel noise = noise_of(stack, camera);
  return wrap_phase(stack, fit_algorithm("auto", stack, noise).algorithm, noise).fate;
}

}  // namespace frangia
