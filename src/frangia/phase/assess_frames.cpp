#include "frangia/phase/assess_frames.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include <Eigen/Core>
#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/core/median.h"

namespace frangia {
namespace {

/// Sum of the squared residuals of a pixel from its least-squares fringe; linear in the frames.
double squared_residual(const PhaseAlgorithm& fit,
                        const std::vector<Eigen::Vector2d>& directions,
                        const std::vector<double>& counts) {
  double mean = 0.0;
  Eigen::Vector2d wave = Eigen::Vector2d::Zero();
  for (std::size_t k = 0; k < counts.size(); ++k) {
    mean += fit.mean[k] * counts[k];
    wave += Eigen::Vector2d(fit.cosine[k], fit.sine[k]) * counts[k];
  }
  double square = 0.0;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    const double residual = counts[k] - mean - directions[k].dot(wave);
    square += residual * residual;
  }
  return square;
}

/// Mean over the measured pixels of the squared residual over its expectation; 1 for camera noise
/// alone.
double residual_ratio(const FrameStack& stack,
                      const std::vector<double>& shifts,
                      const WrappedPhase& map,
                      const NoiseModel& noise,
                      const AssessmentOptions& options) {
  if (shifts.size() < 4) return 0.0;
  const PhaseAlgorithm fit = least_squares(shifts);
  std::vector<Eigen::Vector2d> directions;  // of the wave in the frames
  for (const double shift : shifts)
    directions.emplace_back(std::cos(shift), -std::sin(shift));
  std::vector<double> counts(shifts.size());
  const auto freedom = static_cast<double>(shifts.size() - 3);
  const std::size_t pixels = map.status.pixels().size();
  const std::size_t stride = std::max<std::size_t>(1, pixels / options.samples);
  double ratio = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < pixels; i += stride) {
    if (map.status.pixels()[i] != PixelStatus::Measured) continue;
    for (std::size_t k = 0; k < counts.size(); ++k) {
      counts[k] =
          std::visit([&](const auto& image) { return static_cast<double>(image.pixels()[i]); },
                     stack.frames[k]);
    }
    const double square = squared_residual(fit, directions, counts);
    const double expected =
        freedom * noise.variance(static_cast<double>(map.mean_counts.pixels()[i]));
    ratio += std::min(square / expected, options.max_pixel_ratio);
    count += 1.0;
  }
  return count > 0.0 ? ratio / count : 0.0;
}

double median_contrast(const WrappedPhase& map, std::size_t samples) {
  std::vector<float> contrast;
  const std::size_t stride = std::max<std::size_t>(1, map.status.pixels().size() / samples);
  for (std::size_t i = 0; i < map.status.pixels().size(); i += stride) {
    const float mean = map.mean_counts.pixels()[i];
    if (map.status.pixels()[i] == PixelStatus::Measured && mean > 0.0F)
      contrast.push_back(map.modulation_counts.pixels()[i] / mean);
  }
  return static_cast<double>(median_in_place(std::span(contrast)));
}

double fraction_of(const Image<PixelStatus>& status, PixelStatus which) {
  const auto count = std::count(status.pixels().begin(), status.pixels().end(), which);
  return static_cast<double>(count) / static_cast<double>(std::ssize(status.pixels()));
}

}  // namespace

FrameAssessment assess_frames(const FrameStack& stack,
                              const FittedAlgorithm& fitted,
                              const WrappedPhase& map,
                              const NoiseModel& noise,
                              const AssessmentOptions& options) {
  FrameAssessment assessment{.pattern = stack.pattern.name, .algorithm = fitted.algorithm.name};
  if (fitted.step.found) {
    assessment.nominal_deg = deg_from_rad(fitted.step.nominal_rad);
    assessment.step_deg = deg_from_rad(fitted.step.step_rad);
    assessment.jitter_deg = deg_from_rad(fitted.step.jitter_rad);
    assessment.step_sigma_deg = deg_from_rad(fitted.step.sigma_rad);
  }
  assessment.contrast = median_contrast(map, options.samples);
  assessment.measured_fraction = fraction_of(map.status, PixelStatus::Measured);
  assessment.saturated_fraction = fraction_of(map.status, PixelStatus::Saturated);
  assessment.residual_ratio = residual_ratio(stack, fitted.shifts_rad, map, noise, options);
  assessment.vibration_suspected = assessment.residual_ratio > options.max_residual_ratio;
  return assessment;
}

std::string describe(const FrameAssessment& assessment) {
  std::string text =
      fmt::format("pattern \"{}\" by {}: ", assessment.pattern, assessment.algorithm);
  if (assessment.nominal_deg != 0.0) {
    text += fmt::format("step {:.3f} +- {:.3f} degrees (nominal {:g}), ",
                        assessment.step_deg,
                        assessment.step_sigma_deg,
                        assessment.nominal_deg);
    if (assessment.jitter_deg > 0.0)
      text += fmt::format("step jitter {:.2f} degrees, ", assessment.jitter_deg);
  }
  text += fmt::format("contrast {:.2f}, {:.1f} % measured, {:.1f} % saturated",
                      assessment.contrast,
                      100.0 * assessment.measured_fraction,
                      100.0 * assessment.saturated_fraction);
  if (assessment.residual_ratio > 0.0) {
    text += fmt::format(", {} (residual variance {:.2f} times the noise)",
                        assessment.vibration_suspected
                            ? "something moved or flickered between the frames"
                            : "frames consistent",
                        assessment.residual_ratio);
  }
  return text;
}

}  // namespace frangia
