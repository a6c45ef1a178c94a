#include "frangia/local_fit/internal/fit_quadratic.h"

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

TEST(FitQuadratic, IsExactOnAParaboloidWithPixelsMissing) {
  Image<float> image = paraboloid();
  image(1, 1) = image(2, 5) = image(5, 3) = kMissing;
  const QuadraticFit fit = fit_quadratic(image, {3, 3});
  EXPECT_NEAR(fit.window.value, 5.0F, 1e-5F);
  EXPECT_NEAR(fit.window.slope_x, 0.5F, 1e-5F);
  EXPECT_NEAR(fit.window.slope_y, -0.25F, 1e-5F);
  EXPECT_NEAR(fit.window.residual_variance, 0.0F, 1e-9F);
}

TEST(FitQuadratic, MatchesTheWindowFitWhenNoPixelIsMissing) {
  Image<float> image = paraboloid();
  image(2, 4) += 0.2F;
  const WindowFit window = fit_windows(image, kQuadraticRadius, 3, 1).at(3, 0);
  const QuadraticFit patch = fit_quadratic(image, {3, 3});
  EXPECT_NEAR(patch.variance, value_variance(kQuadraticRadius), 1e-5F);
  EXPECT_NEAR(window.value, patch.window.value, 1e-5F);
  EXPECT_NEAR(window.slope_x, patch.window.slope_x, 1e-5F);
  EXPECT_NEAR(window.slope_y, patch.window.slope_y, 1e-5F);
  EXPECT_NEAR(window.curvature_xx, patch.window.curvature_xx, 1e-5F);
  EXPECT_NEAR(window.curvature_yy, patch.window.curvature_yy, 1e-5F);
  EXPECT_NEAR(window.curvature_xy, patch.window.curvature_xy, 1e-5F);
  EXPECT_NEAR(window.residual_variance, patch.window.residual_variance, 1e-6F);
}

TEST(FitQuadratic, PredictsItsNoise) {
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
    const QuadraticFit fit = fit_quadratic(image, {2, 2});
    squares += static_cast<double>(fit.window.value * fit.window.value);
    predicted += static_cast<double>(fit.variance);
  }
  EXPECT_NEAR(squares / predicted, 1.0, 0.08);
}

TEST(FitQuadratic, LeavesCorrelatedResidualsAtAnEdgeOnly) {
  Image<float> edge(5, 5);
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 5; ++x)
      edge(x, y) = std::abs(static_cast<float>(x) - 1.5F);
  }
  EXPECT_GT(residual_autocorrelation(edge, {2, 2}, fit_quadratic(edge, {2, 2}).window), 0.05F);
  std::mt19937 random(2);
  std::normal_distribution<float> normal;
  int none = 0;
  for (int trial = 0; trial < 200; ++trial) {
    Image<float> noise(5, 5);
    for (float& value : noise.pixels())
      value = normal(random);
    none +=
        residual_autocorrelation(noise, {2, 2}, fit_quadratic(noise, {2, 2}).window) < 0.0F ? 1 : 0;
  }
  EXPECT_GT(none, 180);
}

TEST(FitQuadratic, IsMissingWithTooFewPixels) {
  Image<float> image(5, 5, kMissing);
  image(2, 2) = 1.0F;
  EXPECT_TRUE(std::isnan(fit_quadratic(image, {2, 2}).window.value));
}

}  // namespace
}  // namespace frangia
