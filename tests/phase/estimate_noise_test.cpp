#include "frangia/phase/wrap/estimate_noise.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/phase/wrap/internal/row_rounds.h"

#include "support/display_fringes.h"
#include "support/synthetic_fringes.h"

namespace frangia {
namespace {

using testing::equal_shifts;
using testing::quarter_steps;
using testing::render_frames;
using testing::Scene;

/// Frames of a scene that darkens to one side, with the shot and read noise of an 8-bit camera.
FrameStack shot_noise_frames(const Pattern& pattern,
                             double step_error = 0.0,
                             int height = 400,
                             std::uint32_t seed = 3,
                             double fineness = 1.0,
                             double contrast = 0.7) {
  const double gain_e = 60.0;
  const double read_counts = 0.6;
  std::mt19937 generator(seed);
  std::normal_distribution<double> noise(0.0, 1.0);
  FrameStack stack{.pattern = pattern, .frames = {}, .white_level = 255};
  for (const double shift : pattern.shifts_rad) {
    Image<std::uint8_t> image(640, height);
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width(); ++x) {
        const double mean = 20.0 + 0.16 * x;
        const double light =
            mean * (1.0 + contrast * std::cos(kPi + fineness * (0.1 * x + 0.02 * y - kPi) +
                                              shift * (1.0 + step_error)));
        const double sigma = std::hypot(read_counts, std::sqrt(std::max(0.0, light) / gain_e));
        image(x, y) =
            static_cast<std::uint8_t>(std::lround(std::max(0.0, light + sigma * noise(generator))));
      }
    }
    stack.frames.emplace_back(std::move(image));
  }
  return stack;
}

double true_variance(double counts) {
  return 0.36 + counts / 60.0 + 1.0 / 12.0;
}

TEST(EstimateNoise, FindsShotAndReadNoiseFromFourFrames) {
  const std::vector<FrameStack> stacks = {shot_noise_frames(quarter_steps())};
  const NoiseModel noise = estimate_noise(stacks);
  for (const double counts : {30.0, 70.0, 110.0})
    EXPECT_NEAR(noise.variance(counts) / true_variance(counts), 1.0, 0.06) << counts;
}

TEST(EstimateNoise, FindsTheNoiseOfFramesOfWhichTheFirstIsDarkAllOver) {
  // A part that covers a hundredth of a coarse fringe.
  for (const int frames : {4, 5, 6, 8, 12}) {
    Pattern pattern = quarter_steps();
    pattern.shifts_rad = equal_shifts(frames, kTwoPi / frames);
    const std::vector<FrameStack> stacks = {shot_noise_frames(pattern, 0.0, 400, 3, 0.001)};
    const NoiseModel noise = estimate_noise(stacks);
    for (const double counts : {30.0, 70.0, 110.0})
      EXPECT_NEAR(noise.variance(counts) / true_variance(counts), 1.0, 0.15)
          << frames << " " << counts;
  }
}

TEST(EstimateNoise, FindsTheNoiseOfFramesThatAreCutOffAtEachPixelInOneOfThem) {
  Pattern pattern = quarter_steps();
  pattern.shifts_rad = equal_shifts(6, kTwoPi / 6);
  const std::vector<FrameStack> stacks = {shot_noise_frames(pattern, 0.0, 400, 3, 1.0, 1.4)};
  EXPECT_NEAR(estimate_noise(stacks).variance(70.0) / true_variance(70.0), 1.0, 0.4);
}

TEST(EstimateNoise, OfDarkPixelsIsNotTheBendOfFringesThatAreCutOff) {
  for (const double contrast : {1.1, 1.2}) {
    const std::vector<FrameStack> stacks = {
        shot_noise_frames(quarter_steps(), 0.0, 400, 3, 7.0, contrast)};
    EXPECT_LT(estimate_noise(stacks).variance(0.0), 4.0 * true_variance(0.0)) << contrast;
  }
}

TEST(EstimateNoise, OfFewBitsThatAreStoredInManyIsThatOfTheBrightPart) {
  std::vector<FrameStack> stacks = {shot_noise_frames(quarter_steps())};
  stacks.front().white_level = 65535;
  for (Frame& frame : stacks.front().frames) {
    const auto& image = std::get<Image<std::uint8_t>>(frame);
    Image<std::uint16_t> wide(image.width(), image.height());
    std::copy(image.pixels().begin(), image.pixels().end(), wide.pixels().begin());
    frame = std::move(wide);
  }
  const NoiseModel noise = estimate_noise(stacks);
  for (const double counts : {30.0, 70.0, 110.0})
    EXPECT_NEAR(noise.variance(counts) / true_variance(counts), 1.0, 0.06) << counts;
}

TEST(EstimateNoise, IgnoresAStepError) {
  const std::vector<FrameStack> stacks = {shot_noise_frames(quarter_steps(), 0.05)};
  EXPECT_NEAR(estimate_noise(stacks).variance(70.0) / true_variance(70.0), 1.0, 0.1);
}

TEST(EstimateNoise, FindsShotAndReadNoiseFromThreeFrames) {
  Pattern pattern = quarter_steps();
  pattern.shifts_rad = equal_shifts(3, kTwoPi / 3.0);
  const std::vector<FrameStack> stacks = {shot_noise_frames(pattern)};
  EXPECT_NEAR(estimate_noise(stacks).variance(70.0) / true_variance(70.0), 1.0, 0.15);
}

TEST(EstimateNoise, IsQuantizationNoiseForPerfectFrames) {
  const std::vector<FrameStack> stacks = {
      render_frames({.height = 200}, quarter_steps(), [](int x, int) { return 0.05 * x; })};
  EXPECT_GE(estimate_noise(stacks).variance(30000.0), 1.0 / 12.0);
}

TEST(NoiseSamples, PoolingOverViewsReducesTheScatter) {
  constexpr int kTrials = 12;
  constexpr int kViews = 8;
  double alone = 0.0;
  double pooled = 0.0;
  for (std::uint32_t trial = 0; trial < kTrials; ++trial) {
    NoiseSamples samples;
    for (std::uint32_t view = 0; view < kViews; ++view) {
      const FrameStack stack =
          shot_noise_frames(quarter_steps(), 0.0, 8, 100 + trial * kViews + view);
      samples.add(stack);
      if (view == 0)
        alone += std::pow(estimate_noise({&stack, 1}).variance(70.0) / true_variance(70.0) - 1, 2);
    }
    pooled += std::pow(samples.model().variance(70.0) / true_variance(70.0) - 1.0, 2);
  }
  alone = std::sqrt(alone / kTrials);
  pooled = std::sqrt(pooled / kTrials);
  EXPECT_LT(pooled, 0.5 * alone) << "alone " << alone << ", pooled " << pooled;
  EXPECT_LT(pooled, 0.02);
}

/// Four frames of 640 x 400 pixels; `light` and `sigma` are of the pixel, in counts.
template <typename Light, typename Sigma>
FrameStack frames_with_noise(const Light& light, const Sigma& sigma) {
  std::mt19937 generator(5);
  std::normal_distribution<double> noise(0.0, 1.0);
  FrameStack stack{.pattern = quarter_steps(), .frames = {}, .white_level = 255};
  for (const double shift : stack.pattern.shifts_rad) {
    Image<std::uint8_t> image(640, 400);
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width(); ++x) {
        const double counts = light(x, y) * (1.0 + 0.5 * std::cos(0.1 * x + 0.02 * y + shift));
        image(x, y) =
            static_cast<std::uint8_t>(std::lround(counts + sigma(x, y) * noise(generator)));
      }
    }
    stack.frames.emplace_back(std::move(image));
  }
  return stack;
}

TEST(EstimateNoise, ReadsNoMoreRowsThanFillTheBins) {
  const RowRounds rounds(640, 400, 32'768, 400'000);
  ASSERT_GT(rounds.count(), 1);
  std::vector<char> in_first(400, 0);
  rounds.for_each_row(0, [&](int y) { in_first[static_cast<std::size_t>(y)] = 1; });
  const FrameStack stack = frames_with_noise(
      [](int x, int) { return 40.0 + 0.1 * x; },
      [&](int, int y) { return in_first[static_cast<std::size_t>(y)] != 0 ? 1.0 : 4.0; });
  EXPECT_NEAR(estimate_noise({&stack, 1}).variance(70.0), 1.0 + 1.0 / 12.0, 0.1);
}

TEST(EstimateNoise, ReadsMoreRowsForASmallPart) {
  // A part of 20 x 60 pixels in front of a dark background. Without it there is one brightness.
  const auto light = [](int x, int y) {
    return x >= 300 && x < 320 && y >= 100 && y < 160 ? 150.0 : 40.0;
  };
  const FrameStack stack =
      frames_with_noise(light, [&](int x, int y) { return std::sqrt(0.5 + light(x, y) / 50.0); });
  const NoiseModel noise = estimate_noise({&stack, 1});
  EXPECT_NEAR(noise.variance(40.0), 0.5 + 40.0 / 50.0 + 1.0 / 12.0, 0.1);
  EXPECT_NEAR(noise.variance(150.0), 0.5 + 150.0 / 50.0 + 1.0 / 12.0, 1.2);
}

TEST(EstimateNoise, IsQuantizationNoiseWithoutFrames) {
  EXPECT_DOUBLE_EQ(estimate_noise({}).variance(100.0), 1.0 / 12.0);
}

TEST(EstimateNoise, IgnoresHarmonicsAndFineFringes) {
  for (const int frames : {3, 4, 6}) {
    const testing::DisplayScene scene{.period_px = 9.0, .gamma = 1.8, .texture = 0.3};
    const FrameStack stack = display_frames(scene, equal_shifts(frames, kTwoPi / frames));
    // The true variance is 1.08. The third harmonic of three frames cannot be separated from their
    // mean. Without the correction the variance is above 20.
    EXPECT_GT(estimate_noise({&stack, 1}).variance(70.0), 0.95) << frames;
    EXPECT_LT(estimate_noise({&stack, 1}).variance(70.0), frames == 3 ? 2.3 : 1.5) << frames;
  }
}

TEST(EstimateNoise, OfThreeFramesIsThatOfThePartAndNotOfADarkBackground) {
  // A part of a fifth of the image with fringes of 8 px, in front of 1 count of background.
  std::mt19937 generator(5);
  std::normal_distribution<double> normal(0.0, 1.0);
  FrameStack stack{.pattern = {.shifts_rad = equal_shifts(3, kTwoPi / 3)}, .frames = {}};
  for (const double shift : stack.pattern.shifts_rad) {
    Image<std::uint8_t> image(320, 256);
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width(); ++x) {
        const bool is_part = x >= 80 && x < 220 && y >= 60 && y < 180;
        const double light =
            is_part ? (40.0 + 0.4 * x) * (1.0 + 0.8 * std::cos(0.8 * x + shift)) : 1.0;
        const double counts = light + std::sqrt(0.01 + light / 60.0) * normal(generator);
        image(x, y) = static_cast<std::uint8_t>(std::lround(std::clamp(counts, 0.0, 255.0)));
      }
    }
    stack.frames.emplace_back(std::move(image));
  }
  for (const double counts : {80.0, 120.0})
    EXPECT_NEAR(estimate_noise({&stack, 1}).variance(counts) / (counts / 60.0 + 0.093), 1.0, 0.25)
        << counts;
}

}  // namespace
}  // namespace frangia
