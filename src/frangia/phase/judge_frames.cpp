#include "frangia/phase/judge_frames.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/angles.h"

namespace frangia {
namespace {

constexpr std::size_t kSamples = 100'000;

/// Beyond this the residual is no noise: a noise model is good to some 10 %.
constexpr double kSuspicious = 1.6;

/// What each frame holds beyond the waves of `shifts`, as weights of the frames: a row a frame.
std::vector<std::vector<double>> left_weights(const std::vector<double>& shifts) {
  const PhaseAlgorithm fit = least_squares(shifts);
  std::vector<std::vector<double>> rows;
  for (std::size_t k = 0; k < shifts.size(); ++k) {
    std::vector<double> row;
    for (std::size_t j = 0; j < shifts.size(); ++j) {
      row.push_back((j == k ? 1.0 : 0.0) - fit.mean[j] - std::cos(shifts[k]) * fit.cosine[j] +
                    std::sin(shifts[k]) * fit.sine[j]);
    }
    rows.push_back(row);
  }
  return rows;
}

/// Median, over measured pixels, of the residual's square over its expectation, scaled to be 1 for
/// Gaussian noise of one degree of freedom or more.
double residual_ratio(const FrameStack& stack,
                      const std::vector<double>& shifts,
                      const WrappedPhase& map,
                      const NoiseModel& noise) {
  if (shifts.size() < 4) return 0.0;
  const auto rows = left_weights(shifts);
  const auto freedom = static_cast<double>(shifts.size() - 3);
  const std::size_t pixels = map.fate.pixels().size();
  const std::size_t stride = std::max<std::size_t>(1, pixels / kSamples);
  double ratio = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < pixels; i += stride) {
    if (map.fate.pixels()[i] != PixelFate::Measured) continue;
    std::vector<double> counts;
    for (const Frame& frame : stack.frames) {
      counts.push_back(std::visit(
          [&](const auto& image) { return static_cast<double>(image.pixels()[i]); }, frame));
    }
    double square = 0.0;
    for (const auto& row : rows) {
      double left = 0.0;
      for (std::size_t k = 0; k < counts.size(); ++k)
        left += row[k] * counts[k];
      square += left * left;
    }
    const double expected =
        freedom * noise.variance(static_cast<double>(map.mean_counts.pixels()[i]));
    ratio += std::min(square / expected, 25.0);  // a depth edge's few pixels do not decide
    count += 1.0;
  }
  return count > 0.0 ? ratio / count : 0.0;
}

double median_contrast(const WrappedPhase& map) {
  std::vector<float> contrast;
  const std::size_t stride = std::max<std::size_t>(1, map.fate.pixels().size() / kSamples);
  for (std::size_t i = 0; i < map.fate.pixels().size(); i += stride) {
    const float mean = map.mean_counts.pixels()[i];
    if (map.fate.pixels()[i] == PixelFate::Measured && mean > 0.0F)
      contrast.push_back(map.modulation_counts.pixels()[i] / mean);
  }
  if (contrast.empty()) return 0.0;
  const auto middle = contrast.begin() + std::ssize(contrast) / 2;
  std::nth_element(contrast.begin(), middle, contrast.end());
  return static_cast<double>(*middle);
}

double share(const Image<PixelFate>& fate, PixelFate which) {
  const auto count = std::count(fate.pixels().begin(), fate.pixels().end(), which);
  return static_cast<double>(count) / static_cast<double>(std::ssize(fate.pixels()));
}

}  // namespace

FrameVerdict judge_frames(const FrameStack& stack,
                          const FittedAlgorithm& fitted,
                          const WrappedPhase& map,
                          const NoiseModel& noise) {
  FrameVerdict verdict{.pattern = stack.pattern.name, .algorithm = fitted.algorithm.name};
  if (fitted.step.found) {
    verdict.nominal_deg = deg_from_rad(fitted.step.nominal_rad);
    verdict.step_deg = deg_from_rad(fitted.step.step_rad);
    verdict.jitter_deg = deg_from_rad(fitted.step.jitter_rad);
    verdict.step_sigma_deg = deg_from_rad(fitted.step.sigma_rad);
  }
  verdict.contrast = median_contrast(map);
  verdict.measured_share = share(map.fate, PixelFate::Measured);
  verdict.saturated_share = share(map.fate, PixelFate::Saturated);
  verdict.residual_ratio = residual_ratio(stack, fitted.shifts_rad, map, noise);
  verdict.vibration_suspected = verdict.residual_ratio > kSuspicious;
  return verdict;
}

std::string in_words(const FrameVerdict& verdict) {
  std::string text = fmt::format("pattern \"{}\" by {}: ", verdict.pattern, verdict.algorithm);
  if (verdict.nominal_deg != 0.0) {
    text += fmt::format("steps of {:.3f} +- {:.3f} degrees for {:g}, ",
                        verdict.step_deg,
                        verdict.step_sigma_deg,
                        verdict.nominal_deg);
    if (verdict.jitter_deg > 0.0)
      text += fmt::format("uneven by some {:.2f} degrees, ", verdict.jitter_deg);
  }
  text += fmt::format("contrast {:.2f}, {:.1f} % measured, {:.1f} % saturated",
                      verdict.contrast,
                      100.0 * verdict.measured_share,
                      100.0 * verdict.saturated_share);
  if (verdict.residual_ratio > 0.0) {
    text +=
        fmt::format(", {} ({:.2f} times the noise's variance is left over)",
                    verdict.vibration_suspected ? "something moved or flickered between the frames"
                                                : "frames consistent",
                    verdict.residual_ratio);
  }
  return text;
}

}  // namespace frangia
