#include "frangia/acquisition/internal/assess_set.h"

#include <algorithm>
#include <cmath>

#include "frangia/phase/algorithm/estimate_shifts.h"
#include "frangia/phase/algorithm/estimate_step.h"
#include "frangia/phase/algorithm/fit_algorithm.h"
#include "frangia/phase/waveform/assess_frames.h"
#include "frangia/phase/wrap/estimate_noise.h"
#include "frangia/phase/wrap/wrap_phase.h"

namespace frangia {
namespace {

/// Ratio of residual to noise variance above which a set with a phase shifter shows vibration.
/// Piezo steps that are wrong by a degree stay below it.
constexpr double kVibratingPiezo = 6.0;
/// Gain errors above this are failed estimates, such as a step wrong by a fringe.
constexpr double kMaxGainError = 0.3;

NoiseModel noise_of(const FrameStack& stack, const std::optional<NoiseModel>& camera) {
  return camera ? *camera : estimate_noise({&stack, 1});
}

/// Estimates the gain error: by a fit to all shifts for six frames or more, else by the mean step.
void find_gain(const FrameStack& stack, const NoiseModel& noise, SetAssessment& assessment) {
  const std::vector<double>& nominal = stack.pattern.shifts_rad;
  if (nominal.size() >= 6) {
    const ShiftEstimate shifts = estimate_shifts(stack, noise);
    double covariance = 0.0;
    double variance = 0.0;
    double mean_nominal = 0.0;
    double mean_found = 0.0;
    const auto count = static_cast<double>(nominal.size());
    for (std::size_t i = 0; i < nominal.size(); ++i) {
      mean_nominal += nominal[i] / count;
      mean_found += shifts.shifts_rad[i] / count;
    }
    for (std::size_t i = 0; i < nominal.size(); ++i) {
      covariance += (nominal[i] - mean_nominal) * (shifts.shifts_rad[i] - mean_found);
      variance += (nominal[i] - mean_nominal) * (nominal[i] - mean_nominal);
    }
    assessment.step_found = shifts.found;
    assessment.gain_error = covariance / variance - 1.0;
  } else {
    const StepEstimate step = estimate_step(stack);
    assessment.step_found = step.found;
    assessment.gain_error = step.gain_error();
  }
  assessment.step_found = assessment.step_found && std::abs(assessment.gain_error) < kMaxGainError;
}

}  // namespace

SetAssessment assess_set(std::span<const FrameStack> exposures,
                         const std::optional<NoiseModel>& camera,
                         bool shifter) {
  SetAssessment assessment;
  double best_share = -1.0;
  const FrameStack* best = nullptr;
  FrameAssessment best_assessment;
  for (const FrameStack& stack : exposures) {
    const NoiseModel noise = noise_of(stack, camera);
    const FittedAlgorithm fitted = fit_algorithm("auto", stack, noise);
    const FrameAssessment frame_assessment =
        assess_frames(stack, fitted, wrap_phase(stack, fitted.algorithm, noise), noise);
    if (frame_assessment.measured_fraction <= best_share) continue;
    best_share = frame_assessment.measured_fraction;
    best = &stack;
    best_assessment = frame_assessment;
  }
  if (best == nullptr) return assessment;
  const bool vibrating =
      shifter ? best_assessment.residual_ratio > kVibratingPiezo : best_assessment.exceeds_noise;
  if (shifter) find_gain(*best, noise_of(*best, camera), assessment);
  assessment.moved = camera && vibrating;
  return assessment;
}

Image<PixelStatus> pixel_status_of(const FrameStack& stack,
                                   const std::optional<NoiseModel>& camera) {
  const NoiseModel noise = noise_of(stack, camera);
  return wrap_phase(stack, fit_algorithm("auto", stack, noise).algorithm, noise).status;
}

}  // namespace frangia
