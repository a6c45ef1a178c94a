#include "frangia/phase/algorithm/fit_algorithm.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/phase/algorithm/estimate_shifts.h"
#include "frangia/phase/algorithm/published_algorithms.h"
#include "frangia/phase/waveform/assess_frames.h"

namespace frangia {
namespace {

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

void fit_waveform_of(const FrameStack& stack, const NoiseModel& noise, FittedAlgorithm& out) {
  out.waveform = fit_waveform(stack, out.shifts_rad, noise);
  compensate_gains(out.waveform.gains, out.waveform.steady_share, out.shifts_rad, out.algorithm);
}

FittedAlgorithm fit_advanced_iterative(const FrameStack& stack,
                                       const NoiseModel& noise,
                                       const Run& run) {
  static_cast<void>(
      make_algorithm("aia", stack.pattern.shifts_rad));  // checks the number of frames
  const ShiftEstimate shifts = estimate_shifts(stack, noise);
  if (!shifts.found) {
    run.warn(fmt::format(
        "pattern \"{}\": no set of shifts fits the frames within their noise (residual variance "
        "{:.3g} counts squared, {:.3g} expected), so the shifts of scan.toml are used",
        stack.pattern.name,
        shifts.residual_counts2,
        shifts.expected_counts2));
  }
  FittedAlgorithm out{
      .algorithm = least_squares(shifts.shifts_rad), .step = {}, .shifts_rad = shifts.shifts_rad};
  out.algorithm.name = "aia";
  fit_waveform_of(stack, noise, out);
  return out;
}

}  // namespace

FittedAlgorithm fit_algorithm(const std::string& name,
                              const FrameStack& stack,
                              const NoiseModel& noise,
                              const Run& run,
                              std::optional<double> gain_error) {
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
  if (chosen == "aia") return fit_advanced_iterative(stack, noise, run);
  FittedAlgorithm out;
  if (angular || chosen == "carre" || chosen == "global-carre") {
    out.step = estimate_step(stack);
    out.gain_error = angular && gain_error ? *gain_error : pooled_gain_error({&out.step, 1});
  }
  // The step of these frames determines the ripple, the gain of the shifter the constant.
  const double own = out.step.found ? out.step.gain_error() : out.gain_error;
  const double constant = (out.gain_error - own) * mean_of(pattern.shifts_rad);
  out.algorithm = make_algorithm(chosen, pattern.shifts_rad, own);
  subtract_phase_offset(constant, out.algorithm);
  for (const double shift : pattern.shifts_rad)
    out.shifts_rad.push_back(shift * (1.0 + own) + constant);
  fit_waveform_of(stack, noise, out);
  return out;
}

FittedAlgorithm fit_algorithm(const LinearAlgorithm& own,
                              const FrameStack& stack,
                              const NoiseModel& noise) {
  if (!fits(own, stack.pattern.shifts_rad)) {
    std::vector<double> shifts_deg;
    for (const double shift : own.shifts_rad)
      shifts_deg.push_back(deg_from_rad(shift));
    throw Error(ErrorKind::Input,
                fmt::format("algorithm \"{}\" is made for frames at {:g} degrees, and pattern "
                            "\"{}\" has others; change shifts_deg and the coefficients, or choose "
                            "another algorithm",
                            own.algorithm.name,
                            fmt::join(shifts_deg, ", "),
                            stack.pattern.name));
  }
  FittedAlgorithm out{
      .algorithm = own.algorithm, .step = {}, .shifts_rad = stack.pattern.shifts_rad};
  fit_waveform_of(stack, noise, out);
  return out;
}

}  // namespace frangia
