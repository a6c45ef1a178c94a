// Views whose noise differs from that of the others: frames without noise, and of another gain.
#include "frangia/phase/wrap/noise_of_view.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"

namespace frangia {
namespace {

constexpr double kAt = 63.75;  ///< counts

/// Fringes on a plane with noise of this standard deviation, and counts that frame 1 has besides.
template <class More>
FrameStack fringes_with(double sigma, unsigned seed, More more) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  FrameStack stack{.pattern = {.name = "f", .period_px = 20.0, .shifts_rad = {}}, .frames = {}};
  for (int k = 0; k < 4; ++k) {
    stack.pattern.shifts_rad.push_back(0.25 * kTwoPi * k);
    Image<std::uint8_t> image(240, 200);
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width(); ++x) {
        const double light = 90.0 + 60.0 * std::cos(0.3 * x + 0.05 * y + 0.25 * kTwoPi * k) +
                             (k == 1 ? more(x, y) : 0.0) + sigma * normal(generator);
        image(x, y) = static_cast<std::uint8_t>(std::lround(std::clamp(light, 0.0, 255.0)));
      }
    }
    stack.frames.emplace_back(std::move(image));
  }
  return stack;
}

FrameStack fringes(double sigma, unsigned seed) {
  return fringes_with(sigma, seed, [](int, int) { return 0.0; });
}

NoiseSamples samples_of(const FrameStack& stack) {
  NoiseSamples out;
  out.add(stack);
  return out;
}

TEST(CommonNoise, IsThatOfMostViews) {
  std::vector<NoiseSamples> views;
  for (const double sigma : {2.0, 0.0, 2.0, 2.0})
    views.push_back(samples_of(fringes(sigma, static_cast<unsigned>(views.size()))));
  EXPECT_NEAR(common_noise(views).variance(kAt), 4.0 + 1.0 / 12.0, 0.3);
  views.push_back(samples_of(fringes(9.0, 7)));
  EXPECT_NEAR(common_noise(views).variance(kAt), 4.0 + 1.0 / 12.0, 0.3);
}

TEST(CommonNoise, IsThatOfAllViewsWhereTheyAgree) {
  NoiseSamples all;
  std::vector<NoiseSamples> views;
  for (const unsigned seed : {1U, 2U, 3U}) {
    const FrameStack stack = fringes(1.5, seed);
    all.add(stack);
    views.push_back(samples_of(stack));
  }
  EXPECT_EQ(common_noise(views).variance(kAt), all.model().variance(kAt));
}

TEST(NoiseOfView, IsWhatIsKnownWhereTheViewAgrees) {
  const FrameStack stack = fringes(1.8, 11);
  const NoiseModel known{.floor_counts2 = 4.0};
  EXPECT_EQ(noise_of_view({&stack, 1}, known).variance(kAt), known.variance(kAt));
}

TEST(NoiseOfView, IsItsOwnWhereItHasLessOrMore) {
  const NoiseModel known{.floor_counts2 = 4.0};
  for (const double sigma : {0.5, 8.0}) {
    const FrameStack stack = fringes(sigma, 12);
    EXPECT_NEAR(
        noise_of_view({&stack, 1}, known).variance(kAt) / (sigma * sigma + 1.0 / 12.0), 1.0, 0.15)
        << sigma;
  }
}

TEST(NoiseOfView, TakesWhatMovedBetweenTheFramesForNoNoise) {
  // A print that frame 1 shows elsewhere: smooth over two pixels, large over four.
  const FrameStack stack = fringes_with(
      1.0, 13, [](int x, int y) { return 25.0 * std::sin(0.9 * x + 2.0 * std::sin(0.2 * y)); });
  const NoiseModel known{.floor_counts2 = 1.0};
  EXPECT_EQ(noise_of_view({&stack, 1}, known).variance(kAt), known.variance(kAt));
}

}  // namespace
}  // namespace frangia
