#include "frangia/views/fit_patch.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "frangia/core/missing.h"

namespace frangia {
namespace {

Image<float> paraboloid() {
  Image<float> image(7, 7);
  for (int y = 0; y < 7; ++y) {
    for (int x = 0; x < 7; ++x) {
      const auto dx = static_cast<float>(x - 3);
      const auto dy = static_cast<float>(y - 3);
      image(x, y) = 5.0F + 0.5F * dx - 0.25F * dy + 0.3F * dx * dx - 0.1F * dx * dy;
    }
  }
  return image;
}

TEST(FitPatch, IsExactOnAParaboloidWithPixelsMissing) {
  Image<float> image = paraboloid();
  image(1, 1) = image(2, 5) = image(5, 3) = kMissing;
  const PatchFit fit = fit_patch(image, {3, 3});
  EXPECT_NEAR(fit.window.middle, 5.0F, 1e-5F);
  EXPECT_NEAR(fit.window.slope_x, 0.5F, 1e-5F);
  EXPECT_NEAR(fit.window.slope_y, -0.25F, 1e-5F);
  EXPECT_NEAR(fit.window.rest, 0.0F, 1e-9F);
}

TEST(FitPatch, FindsOfAWholePatchWhatAWindowDoes) {
  Image<float> image = paraboloid();
  image(2, 4) += 0.2F;
  const WindowFit window = fit_windows(image, kPatchRadius, 3, 1).at(3, 0);
  const PatchFit patch = fit_patch(image, {3, 3});
  EXPECT_NEAR(patch.variance, middle_variance(kPatchRadius), 1e-5F);
  EXPECT_NEAR(window.middle, patch.window.middle, 1e-5F);
  EXPECT_NEAR(window.slope_x, patch.window.slope_x, 1e-5F);
  EXPECT_NEAR(window.slope_y, patch.window.slope_y, 1e-5F);
  EXPECT_NEAR(window.bend_x, patch.window.bend_x, 1e-5F);
  EXPECT_NEAR(window.bend_y, patch.window.bend_y, 1e-5F);
  EXPECT_NEAR(window.twist, patch.window.twist, 1e-5F);
  EXPECT_NEAR(window.rest, patch.window.rest, 1e-6F);
}

TEST(FitPatch, KnowsWhatItLeavesOfTheNoise) {
  std::mt19937 random(1);
  std::normal_distribution<float> normal;
  double squares = 0.0;
  double predicted = 0.0;
  constexpr int kTrials = 4000;
  for (int trial = 0; trial < kTrials; ++trial) {
    Image<float> image(5, 5);
    for (float& value : image.pixels())
      value = normal(random);
    image(0, 2) = image(0, 3) = kMissing;
    const PatchFit fit = fit_patch(image, {2, 2});
    squares += static_cast<double>(fit.window.middle * fit.window.middle);
    predicted += static_cast<double>(fit.variance);
  }
  EXPECT_NEAR(squares / predicted, 1.0, 0.08);
}

TEST(FitPatch, SeesStructureInAnEdgeAndNoneInNoise) {
  Image<float> edge(5, 5);
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 5; ++x)
      edge(x, y) = std::abs(static_cast<float>(x) - 1.5F);
  }
  EXPECT_GT(structure_of(edge, {2, 2}, fit_patch(edge, {2, 2}).window), 0.05F);
  std::mt19937 random(2);
  std::normal_distribution<float> normal;
  int none = 0;
  for (int trial = 0; trial < 200; ++trial) {
    Image<float> noise(5, 5);
    for (float& value : noise.pixels())
      value = normal(random);
    none += structure_of(noise, {2, 2}, fit_patch(noise, {2, 2}).window) < 0.0F ? 1 : 0;
  }
  EXPECT_GT(none, 180);
}

TEST(FitPatch, RefusesToGuess) {
  Image<float> image(5, 5, kMissing);
  image(2, 2) = 1.0F;
  EXPECT_TRUE(std::isnan(fit_patch(image, {2, 2}).window.middle));
}

}  // namespace
}  // namespace frangia
