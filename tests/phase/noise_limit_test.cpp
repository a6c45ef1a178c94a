#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/random.h"
#include "frangia/phase/algorithm/fit_algorithm.h"
#include "frangia/phase/waveform/assess_frames.h"
#include "frangia/phase/wrap/estimate_noise.h"
#include "frangia/phase/wrap/wrap_phase.h"

#include "support/synthetic_fringes.h"

namespace frangia {
namespace {

using testing::quarter_steps;
using testing::tilted_plane;

constexpr int kColumnsSeen = 640;
constexpr int kRowsSeen = 300;
const NoiseModel kShotNoise = NoiseModel::from_camera(40.0, 30.0);

/// Frames with the shot and read noise of an 8-bit camera.
FrameStack noisy_frames(double exposure, double step_error, double flicker_rad = 0.0) {
  FrameStack stack{.pattern = quarter_steps(), .frames = {}, .white_level = 255};
  for (std::size_t k = 0; k < 4; ++k) {
    Image<std::uint8_t> image(kColumnsSeen, kRowsSeen);
    for (int y = 0; y < kRowsSeen; ++y) {
      for (int x = 0; x < kColumnsSeen; ++x) {
        const double shift = stack.pattern.shifts_rad[k] * (1.0 + step_error) +
                             (k == 2 ? flicker_rad * std::sin(0.05 * y) : 0.0);
        const double light = 120.0 * exposure * (1.0 + 0.8 * std::cos(tilted_plane(x, y) + shift));
        const std::uint64_t place =
            hash(hash(k + 5, static_cast<std::uint64_t>(y)), static_cast<std::uint64_t>(x));
        const double sigma = std::sqrt(kShotNoise.variance(light) - 1.0 / 12.0);
        image(x, y) = static_cast<std::uint8_t>(
            std::lround(std::clamp(light + sigma * normal_from(place), 0.0, 255.0)));
      }
    }
    stack.frames.emplace_back(std::move(image));
  }
  return stack;
}

struct Decoded {
  double rms_rad = 0.0;
  double chi_square = 0.0;
  double limit_rad = 0.0;  ///< Cramér-Rao bound for the mean variance of a frame
};

Decoded decode(const std::string& name, double exposure, double step_error, NoiseModel noise) {
  const FrameStack stack = noisy_frames(exposure, step_error);
  const FittedAlgorithm fitted = fit_algorithm(name, stack, noise);
  const WrappedPhase map = wrap_phase(stack, fitted.algorithm, noise, {.max_sigma_rad = 1.0F});
  Decoded out;
  for (int y = 0; y < kRowsSeen; ++y) {
    for (int x = 0; x < kColumnsSeen; ++x) {
      const double error = wrap_rad(map.phase_rad(x, y) - tilted_plane(x, y));
      out.rms_rad += error * error / (kColumnsSeen * kRowsSeen);
      out.chi_square += std::pow(error / map.sigma_rad(x, y), 2) / (kColumnsSeen * kRowsSeen);
    }
  }
  out.rms_rad = std::sqrt(out.rms_rad);
  out.limit_rad = std::sqrt(0.5 * kShotNoise.variance(120.0 * exposure)) / (96.0 * exposure);
  return out;
}

TEST(NoiseLimit, LeastSquaresAndGlobalCarreReachTheBoundWithAndWithoutAStepError) {
  for (const double error : {-0.05, 0.0, 0.05}) {
    const Decoded global = decode("global-carre", 0.9, error, kShotNoise);
    EXPECT_NEAR(global.rms_rad / global.limit_rad, 1.0, 0.05) << error;
  }
  const Decoded plain = decode("least-squares", 0.9, 0.0, kShotNoise);
  EXPECT_NEAR(plain.rms_rad / plain.limit_rad, 1.0, 0.05);
  EXPECT_GT(decode("least-squares", 0.9, 0.05, kShotNoise).rms_rad, 0.025);
}

TEST(NoiseLimit, SigmaMatchesTheErrorsAtAllExposures) {
  for (const double exposure : {0.15, 0.3, 0.6, 1.0}) {
    for (const auto* name : {"least-squares", "schwider", "carre", "global-carre"}) {
      const double chi_square = decode(name, exposure, 0.0, kShotNoise).chi_square;
      EXPECT_GT(chi_square, 0.9) << name << " at " << exposure;
      EXPECT_LT(chi_square, 1.1) << name << " at " << exposure;
    }
  }
}

TEST(NoiseLimit, SigmaMatchesTheErrorsForEstimatedNoise) {
  for (const double exposure : {0.15, 0.3, 0.6, 1.0}) {
    const FrameStack stack = noisy_frames(exposure, 0.0);
    const NoiseModel noise = estimate_noise({&stack, 1});
    const double chi_square = decode("least-squares", exposure, 0.0, noise).chi_square;
    EXPECT_GT(chi_square, 0.9) << exposure;
    EXPECT_LT(chi_square, 1.1) << exposure;
  }
}

/// Frames of a camera that encodes its light as webcams do, of fringes that are sinusoidal in its
/// counts, on a part that is 10 counts bright at the left and 150 at the right. `first`: the first
/// column that is lit.
FrameStack encoded_frames(std::size_t frames, double full_e, double read_e, int first = 0) {
  FrameStack stack{.pattern = quarter_steps(), .frames = {}, .white_level = 255};
  stack.pattern.shifts_rad =
      testing::equal_shifts(static_cast<int>(frames), kTwoPi / static_cast<double>(frames));
  for (std::size_t k = 0; k < frames; ++k) {
    Image<std::uint8_t> image(kColumnsSeen, kRowsSeen);
    for (int y = 0; y < kRowsSeen; ++y) {
      for (int x = 0; x < kColumnsSeen; ++x) {
        const double seen =
            (10.0 + 140.0 * x / kColumnsSeen) *
            (1.0 + 0.6 * std::cos(tilted_plane(x, y) + stack.pattern.shifts_rad[k]));
        const double electrons = x < first ? 0.0 : full_e * std::pow(seen / 255.0, 2.2);
        const std::uint64_t place =
            hash(hash(k + 5, static_cast<std::uint64_t>(y)), static_cast<std::uint64_t>(x));
        const double noisy =
            electrons + std::hypot(std::sqrt(electrons), read_e) * normal_from(place);
        image(x, y) = static_cast<std::uint8_t>(std::lround(
            std::clamp(255.0 * std::pow(std::max(noisy, 0.0) / full_e, 1.0 / 2.2), 0.0, 255.0)));
      }
    }
    stack.frames.emplace_back(std::move(image));
  }
  return stack;
}

TEST(NoiseLimit, SigmaMatchesTheErrorsOfACameraThatEncodesItsLight) {
  for (const std::size_t frames : {4U, 6U}) {
    for (const auto& [full_e, read_e] : {std::pair{8000.0, 3.0}, {3000.0, 12.0}}) {
      const FrameStack stack = encoded_frames(frames, full_e, read_e);
      const NoiseModel noise = estimate_noise({&stack, 1});
      const PhaseAlgorithm algorithm = least_squares(stack.pattern.shifts_rad);
      const WrappedPhase map = wrap_phase(stack, algorithm, noise, {.max_sigma_rad = 1.0F});
      for (const int begin : {160, 320, 480}) {
        double square = 0.0;
        double count = 0.0;
        for (int y = 0; y < kRowsSeen; ++y) {
          for (int x = begin; x < begin + 160; ++x) {
            const double error = wrap_rad(map.phase_rad(x, y) - tilted_plane(x, y));
            if (!std::isfinite(map.sigma_rad(x, y))) continue;
            square += std::pow(error / map.sigma_rad(x, y), 2);
            count += 1.0;
          }
        }
        EXPECT_GT(count, 0.95 * 160 * kRowsSeen);
        EXPECT_NEAR(std::sqrt(square / count), 1.0, 0.2)
            << frames << " frames, read noise " << read_e << " e, columns from " << begin;
      }
    }
  }
}

TEST(NoiseLimit, TheDarkBackgroundOfACameraThatEncodesItsLightIsNotMeasured) {
  // Its noise is cut off at 0 counts, and far beyond that of the part, which is bright.
  constexpr int kLit = 560;
  const FrameStack stack = encoded_frames(4, 20000.0, 40.0, kLit);
  const NoiseModel noise = estimate_noise({&stack, 1});
  const WrappedPhase map = wrap_phase(stack, least_squares(stack.pattern.shifts_rad), noise);
  std::size_t background = 0;
  std::size_t part = 0;
  for (int y = 0; y < kRowsSeen; ++y)
    for (int x = 0; x < kColumnsSeen; ++x)
      if (map.status(x, y) == PixelStatus::Measured) ++(x < kLit ? background : part);
  EXPECT_LT(background, kRowsSeen * kLit / 20);
  EXPECT_GT(part, kRowsSeen * (kColumnsSeen - kLit) * 19 / 20);
}

FrameAssessment assessment_of(const FrameStack& stack) {
  const FittedAlgorithm fitted = fit_algorithm("auto", stack, kShotNoise);
  const WrappedPhase map = wrap_phase(stack, fitted.algorithm, kShotNoise);
  return assess_frames(stack, fitted, map, kShotNoise);
}

TEST(AssessFrames, ReportsStepAndContrastOfGoodFrames) {
  const FrameAssessment assessment = assessment_of(noisy_frames(0.9, 0.03));
  EXPECT_NEAR(assessment.step_deg, 92.7, 5.0 * assessment.step_sigma_deg);
  EXPECT_NEAR(assessment.contrast, 0.8, 0.02);
  EXPECT_NEAR(assessment.residual_ratio, 1.0, 0.1);
  EXPECT_FALSE(assessment.exceeds_noise);
  EXPECT_NE(describe(assessment).find("frames consistent"), std::string::npos);
}

TEST(AssessFrames, FindsThatAFrameMovedBeyondTheNoise) {
  const FrameAssessment assessment = assessment_of(noisy_frames(0.9, 0.0, 0.2));
  EXPECT_TRUE(assessment.exceeds_noise);
  EXPECT_GT(assessment.residual_ratio, 2.0);
}

TEST(AssessFrames, ReportsNoMeasuredPixelsForSaturatedFrames) {
  const FrameAssessment assessment = assessment_of(noisy_frames(30.0, 0.0));
  EXPECT_GT(assessment.saturated_fraction, 0.9);
  EXPECT_LT(assessment.measured_fraction, 0.05);
}

}  // namespace
}  // namespace frangia
