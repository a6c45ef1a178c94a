#include "frangia/phase/waveform/assess_frames.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/core/statistics.h"
#include "frangia/phase/waveform/internal/residual_model.h"
#include "frangia/phase/waveform/systematic_phase.h"

namespace frangia {
namespace {

/// Share of the excess residual that harmonics and gains may leave unexplained: their amplitude
/// varies over the image with blur and ambient light.
constexpr double kMaxUnexplainedShare = 0.1;

/// A pixel's squared residual counts up to this multiple of its expectation, so that the few pixels
/// on depth edges do not decide: (5 sigma)^2.
constexpr double kMaxPixelRatio = 25.0;

/// Means over the measured pixels of the squared residual over its expectation; 1 for camera noise
/// alone.
struct ResidualRatios {
  double all = 0.0;
  double unexplained = 0.0;
};

ResidualRatios residual_ratios(const FrameStack& stack,
                               const FittedAlgorithm& fitted,
                               const WrappedPhase& map,
                               const NoiseModel& noise,
                               const AssessmentOptions& options) {
  ResidualRatios out;
  if (fitted.shifts_rad.size() < 4) return out;
  const ResidualModel model(fitted);
  const bool explains = model.explains_something();
  std::vector<double> counts(fitted.shifts_rad.size());
  const auto freedom = static_cast<double>(counts.size() - 3);
  const std::size_t pixels = map.status.pixels().size();
  const std::size_t stride = std::max<std::size_t>(1, pixels / options.samples);
  double count = 0.0;
  for (std::size_t i = 0; i < pixels; i += stride) {
    if (map.status.pixels()[i] != PixelStatus::Measured) continue;
    for (std::size_t k = 0; k < counts.size(); ++k) {
      counts[k] =
          std::visit([&](const auto& image) { return static_cast<double>(image.pixels()[i]); },
                     stack.frames[k]);
    }
    const double expected =
        freedom * noise.variance(static_cast<double>(map.mean_counts.pixels()[i]));
    const auto limited = [&](double square) { return std::min(square / expected, kMaxPixelRatio); };
    out.all += limited(model.squared_residual(counts));
    if (explains) out.unexplained += limited(model.unexplained_residual(counts));
    count += 1.0;
  }
  if (count == 0.0) return {};
  out.all /= count;
  out.unexplained = explains ? out.unexplained / count : out.all;
  return out;
}

/// Phase error that deserves a warning: a third of the phase noise of bright 8-bit frames.
constexpr double kMaterial_rad = 0.004;
/// Contrast that no sine reaches, even with noise.
constexpr double kMaxContrast = 1.03;

std::string harmonic_finding(const FrameAssessment& assessment) {
  constexpr std::array<const char*, 4> kOrdinals = {"second", "third", "fourth", "fifth"};
  const std::string text =
      fmt::format("a {} harmonic of {:.1f} % of the fringes",
                  kOrdinals.at(static_cast<std::size_t>(assessment.harmonic - 2)),
                  100.0 * assessment.harmonic_share);
  if (assessment.harmonics_corrected) return text + " is corrected";
  if (assessment.harmonic_error_rad <= kMaterial_rad)
    return text + ", which hardly affects the phase by this algorithm";
  return text + fmt::format(
                    " shifts the phase by {:.3f} rad rms: the projector or the camera is not "
                    "linear; measure the response with `frangia response` and give it as "
                    "`undo_response`, or {}",
                    assessment.harmonic_error_rad,
                    assessment.frames < 6 ? "take 6 steps" : "set `algorithm` to least-squares");
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
  assessment.frames = static_cast<int>(fitted.shifts_rad.size());
  if (fitted.step.found) {
    assessment.nominal_deg = deg_from_rad(fitted.step.nominal_rad);
    assessment.step_deg = deg_from_rad(fitted.step.step_rad);
    assessment.jitter_deg = deg_from_rad(fitted.step.jitter_rad);
    assessment.step_sigma_deg = deg_from_rad(fitted.step.sigma_rad);
  }
  assessment.contrast = median_contrast(map, options.samples);
  assessment.measured_fraction = fraction_of(map.status, PixelStatus::Measured);
  assessment.saturated_fraction = fraction_of(map.status, PixelStatus::Saturated);
  const ResidualRatios ratios = residual_ratios(stack, fitted, map, noise, options);
  assessment.residual_ratio = ratios.all;
  assessment.unexplained_ratio = ratios.unexplained;
  const double left = kMaxUnexplainedShare * (ratios.all - ratios.unexplained);
  assessment.exceeds_noise = ratios.unexplained > options.max_residual_ratio + left;
  assessment.harmonic = fitted.waveform.largest_harmonic();
  assessment.harmonic_share = fitted.waveform.waveform.amplitude(assessment.harmonic);
  assessment.harmonic_error_rad = harmonic_phase_error(fitted, nullptr);
  assessment.flicker = fitted.waveform.flicker();
  assessment.flicker_error_rad = fitted.waveform.flicker_error_rad;
  assessment.is_flicker = fitted.waveform.is_flicker;
  return assessment;
}

bool differs_between_frames(const FrameAssessment& assessment) {
  return assessment.exceeds_noise || assessment.flicker_error_rad > kMaterial_rad;
}

bool needs_attention(const FrameAssessment& assessment) {
  return differs_between_frames(assessment) || assessment.harmonic_error_rad > kMaterial_rad ||
         (assessment.contrast > kMaxContrast && assessment.harmonic == 0);
}

std::vector<std::string> findings(const FrameAssessment& assessment) {
  std::vector<std::string> out;
  if (assessment.harmonic > 0) out.push_back(harmonic_finding(assessment));
  if (assessment.contrast > kMaxContrast && assessment.harmonic == 0) {
    out.push_back(fmt::format(
        "a contrast of {:.2f} is more than that of any sine: the projector or the camera is not "
        "linear, or the camera cuts dark pixels off at 0; measure the response with `frangia "
        "response`, and raise the camera's black level",
        assessment.contrast));
  }
  if (assessment.flicker > 0.0) {
    out.push_back(
        fmt::format("the light flickered by {:.1f} % rms between the frames, which is "
                    "compensated",
                    100.0 * assessment.flicker));
  }
  if (assessment.flicker_error_rad > 0.0 && !assessment.is_flicker) {
    out.push_back(fmt::format(
        "light or shifts that differed between the frames shift the phase by {:.3f} rad rms, which "
        "is counted in sigma",
        assessment.flicker_error_rad));
  } else if (assessment.flicker_error_rad > 0.0) {
    out.push_back(fmt::format(
        "the light flickered between the frames, which shifts the phase by {:.3f} rad rms; {} "
        "frames do not determine it: take {} steps or more, or expose for whole periods of the "
        "lamp",
        assessment.flicker_error_rad,
        assessment.frames,
        assessment.frames < 5 ? 5 : 8));
  }
  return out;
}

std::string describe_corrections(std::span<const FrameAssessment> assessments) {
  std::size_t corrected = 0;
  double largest = 0.0;
  for (const FrameAssessment& assessment : assessments) {
    if (!assessment.harmonics_corrected) continue;
    ++corrected;
    largest = std::max(largest, assessment.harmonic_share);
  }
  if (corrected == 0) return {};
  return fmt::format(
      "the response of the projector is corrected in the phase of {} {}: the frames show harmonics "
      "of "
      "up to {:.1f} % of the fringes (`undo_response`)",
      corrected,
      corrected == 1 ? "pattern" : "patterns",
      100.0 * largest);
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
    text += fmt::format(
        ", {} (residual variance {:.2f} times the noise)",
        assessment.exceeds_noise ? "frames differ beyond their noise" : "frames consistent",
        assessment.unexplained_ratio);
  }
  for (const std::string& finding : findings(assessment))
    text += "; " + finding;
  return text;
}

double pooled_gain_error(std::span<const StepEstimate> views) {
  double count = 0.0;
  double mean = 0.0;
  for (const StepEstimate& view : views) {
    if (!view.found) continue;
    count += 1.0;
    mean += view.gain_error();
  }
  if (count == 0.0) return 0.0;
  mean /= count;
  // Independent shift errors of standard deviation sigma shift the phase of a window of four frames
  // by sigma, and change its apparent step by half of that.
  double square = 0.0;
  double noise = 0.0;
  for (const StepEstimate& view : views) {
    if (!view.found) continue;
    const double jitter = 0.5 * view.jitter_rad / view.nominal_rad;
    const double scatter = view.gain_error() - mean;
    const double sigma = view.sigma_rad / view.nominal_rad;
    square += jitter * jitter + scatter * scatter;
    noise += sigma * sigma;
  }
  const double freedom = 2.0 * count - 1.0;
  const double variance = square / freedom / count + noise / (count * count);
  // 4: a mean of two sigmas shrinks to 0.
  const double caution = 4.0 * (1.0 + 5.0 / freedom);
  return mean == 0.0 ? 0.0 : mean * std::max(0.0, 1.0 - caution * variance / (mean * mean));
}

}  // namespace frangia
