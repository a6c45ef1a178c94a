#include "frangia/phase/waveform/systematic_phase.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/phase/wrap/wrap_phase.h"

#include "support/display_fringes.h"
#include "support/synthetic_fringes.h"

namespace frangia {
namespace {

using testing::display_frames;
using testing::display_phase;
using testing::DisplayScene;
using testing::equal_shifts;

/// Errors of the phases of a scene's frames against the formula that made them.
struct PhaseErrors {
  double rms_rad = 0.0;
  double over_sigma = 0.0;  ///< rms of the error over the combined sigma
  double systematic_rad = 0.0;
};

PhaseErrors errors_of(const DisplayScene& scene, int frames, bool correct = false) {
  const std::vector<double> shifts = equal_shifts(frames, kTwoPi / frames);
  const FrameStack stack = display_frames(scene, shifts);
  const NoiseModel noise{.floor_counts2 = scene.noise_counts * scene.noise_counts + 1.0 / 12.0};
  const FittedAlgorithm fitted = fit_algorithm("auto", stack, noise);
  WrappedPhase map = wrap_phase(stack, fitted.algorithm, noise);
  std::optional<ResponseTable> table;
  if (correct) table = own_correction(fitted);
  if (table) correct_response(*table, map);
  PhaseErrors out;
  out.systematic_rad = systematic_phase(fitted, table ? &*table : nullptr).rad;
  double count = 0.0;
  for (int y = 0; y < scene.height; ++y) {
    for (int x = 0; x < scene.width; ++x) {
      if (map.status(x, y) != PixelStatus::Measured) continue;
      const double error =
          wrap_rad(static_cast<double>(map.phase_rad(x, y)) - display_phase(scene, x, y));
      const double sigma = std::hypot(static_cast<double>(map.sigma_rad(x, y)), out.systematic_rad);
      out.rms_rad += error * error;
      out.over_sigma += error * error / (sigma * sigma);
      count += 1.0;
    }
  }
  EXPECT_GT(count, 10000.0);
  out.rms_rad = std::sqrt(out.rms_rad / count);
  out.over_sigma = std::sqrt(out.over_sigma / count);
  return out;
}

TEST(SystematicPhase, OfAGammaOf1_8CoversTheErrorOfThreeToSixFrames) {
  for (const int frames : {3, 4, 5, 6}) {
    const PhaseErrors found = errors_of({.gamma = 1.8}, frames);
    EXPECT_GT(found.over_sigma, 0.7) << frames;
    EXPECT_LT(found.over_sigma, 1.5) << frames;
  }
  EXPECT_GT(errors_of({.gamma = 1.8}, 3).systematic_rad, 0.1);
}

TEST(SystematicPhase, IsZeroForSoundFrames) {
  for (const int frames : {3, 4, 5, 6, 12})
    EXPECT_EQ(errors_of({}, frames).systematic_rad, 0.0) << frames;
}

TEST(SystematicPhase, AfterTheCorrectionOfTheFramesOwnHarmonicsIsTheNoiseOfALinearDisplay) {
  for (const int frames : {3, 4, 5, 6}) {
    const PhaseErrors linear = errors_of({}, frames);
    const PhaseErrors corrected = errors_of({.gamma = 1.8}, frames, true);
    EXPECT_LT(corrected.rms_rad, 1.5 * linear.rms_rad) << frames;
    EXPECT_GT(corrected.over_sigma, 0.7) << frames;
    EXPECT_LT(corrected.over_sigma, 1.5) << frames;
  }
}

/// A square wave after a blur of `sigma` in its phase: its Fourier series, in a table.
std::function<double(double)> blurred_square(double sigma) {
  constexpr int kSteps = 4096;
  std::vector<double> table(kSteps, 0.0);
  for (int i = 0; i < kSteps; ++i) {
    const double phase = kTwoPi * i / kSteps;
    double& light = table[static_cast<std::size_t>(i)];
    for (int n = 1; n < 60; n += 2) {
      light += (n % 4 == 1 ? 1.0 : -1.0) * 4.0 / (kPi * n) * std::cos(n * phase) *
               std::exp(-0.5 * n * n * sigma * sigma);
    }
    light = std::clamp(light, -1.0, 1.0);
  }
  return [table](double phase) {
    const auto step = std::lround(phase / kTwoPi * kSteps);
    return table[static_cast<std::size_t>((step % kSteps + kSteps) % kSteps)];
  };
}

TEST(SystematicPhase, CoversBinaryPatternsWithAnyBlur) {
  for (const double blur_px : {0.5, 1.0, 2.0, 4.0}) {
    for (const int frames : {3, 4, 5, 6, 12}) {
      DisplayScene scene;
      scene.waveform = blurred_square(kTwoPi * blur_px / scene.period_px);
      EXPECT_LT(errors_of(scene, frames, true).over_sigma, 1.5)
          << frames << " frames, blur " << blur_px << " px";
    }
  }
}

TEST(SystematicPhase, CoversResponsesOfThreeFramesThatAreNoPowerLaw) {
  const auto response_of = [](double gamma, double bend) {
    return [=](double phase) {
      const double level = 0.5 + 0.5 * std::cos(phase);
      const double light = std::pow(level, gamma);
      return 2.0 * (light + bend * std::sin(kTwoPi * level)) - 1.0;
    };
  };
  for (const double gamma : {1.4, 1.6, 2.2}) {
    for (const double bend : {-0.05, -0.02, 0.03}) {
      DisplayScene scene;
      scene.waveform = response_of(gamma, bend);
      EXPECT_LT(errors_of(scene, 3, true).over_sigma, 1.5) << "gamma " << gamma << ", " << bend;
    }
  }
}

TEST(SystematicPhase, IsNotCorrectedWhereNothingIsToBeWon) {
  const std::vector<double> shifts = equal_shifts(6, kTwoPi / 6);
  const NoiseModel noise{.floor_counts2 = 1.0 + 1.0 / 12.0};
  const FittedAlgorithm fitted =
      fit_algorithm("auto", display_frames({.gamma = 1.8}, shifts), noise);
  EXPECT_GT(fitted.waveform.largest_harmonic(), 0);  // six steps do not see the second harmonic
  EXPECT_FALSE(own_correction(fitted));
}

TEST(SystematicPhase, FlickerOfTwelveFramesIsCompensated) {
  const double none = errors_of({}, 12).rms_rad;
  double worst = 0.0;
  for (const double start : {1.0, 2.0, 3.0}) {
    DisplayScene scene;
    for (int k = 0; k < 12; ++k)
      scene.gains.push_back(0.028 * std::sin(2.3 * k * k + start));
    worst = std::max(worst, errors_of(scene, 12).rms_rad);
  }
  EXPECT_LT(worst, 1.3 * none);
}

TEST(SystematicPhase, FlickerOfAProjectorWithAGammaInALitRoomIsCompensated) {
  for (const int frames : {5, 6, 8, 12}) {
    for (const double dark_counts : {150.0, 700.0}) {
      DisplayScene scene{.gamma = 1.6,
                         .peak_counts = 2900.0,
                         .dark_counts = dark_counts,
                         .noise_counts = 8.0,
                         .white_level = 4095};
      const PhaseErrors steady = errors_of(scene, frames, true);
      for (const double start : {1.0, 2.0, 3.0}) {
        scene.gains.clear();
        for (int k = 0; k < frames; ++k)
          scene.gains.push_back(0.042 * std::sin(2.3 * k * k + start));
        const PhaseErrors found = errors_of(scene, frames, true);
        EXPECT_LT(found.rms_rad, 1.3 * steady.rms_rad) << frames << ", " << dark_counts;
        EXPECT_LT(found.over_sigma, 1.5) << frames << ", " << dark_counts;
      }
    }
  }
}

TEST(SystematicPhase, CountsFlickerOfThreeAndFourFrames) {
  for (const int frames : {3, 4}) {
    DisplayScene scene{.gains = {0.03, -0.021, 0.001, 0.018}};
    scene.gains.resize(static_cast<std::size_t>(frames));
    const PhaseErrors found = errors_of(scene, frames);
    EXPECT_GT(found.over_sigma, 0.7) << frames;
    EXPECT_LT(found.over_sigma, 1.5) << frames;
  }
}

}  // namespace
}  // namespace frangia
