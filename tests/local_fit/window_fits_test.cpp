#include "frangia/local_fit/window_fits.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "frangia/local_fit/fit_windows.h"

namespace frangia {
namespace {

TEST(WindowFits, HoldEveryQuantityOfEveryWindow) {
  WindowFits fits(5, 2);
  for (int row = 0; row < 2; ++row) {
    for (int quantity = 0; quantity < WindowFits::QuantityCount; ++quantity) {
      float* values = fits.row(static_cast<WindowFits::Quantity>(quantity), row);
      for (int x = 0; x < 5; ++x)
        values[x] = static_cast<float>(100 * row + 10 * quantity + x);
    }
  }
  const WindowFit fit = fits.at(3, 1);
  EXPECT_EQ(fit.mean, 103.0F);
  EXPECT_EQ(fit.slope_x, 113.0F);
  EXPECT_EQ(fit.residual_variance, 153.0F);
  EXPECT_EQ(fit.curvature_xy, 183.0F);
  fits.set_missing_outside(1, 3, 1);
  EXPECT_TRUE(std::isnan(fits.at(0, 1).slope_y));
  EXPECT_FALSE(std::isnan(fits.at(2, 1).slope_y));
  EXPECT_TRUE(std::isnan(fits.at(3, 1).slope_y));
  EXPECT_FALSE(std::isnan(fits.at(0, 0).slope_y));
}

TEST(WindowFits, PredictTheNoiseOfValueAndCorner) {
  std::mt19937 random(5);
  std::normal_distribution<float> normal;
  for (const int radius : {1, 2, 3}) {
    const int side = 2 * radius + 1;
    double value_squares = 0.0;
    double corner_squares = 0.0;
    constexpr int kTrials = 4000;
    for (int trial = 0; trial < kTrials; ++trial) {
      Image<float> noise(side, side);
      for (float& value : noise.pixels())
        value = normal(random);
      const WindowFit fit = fit_windows(noise, radius, radius, 1).at(radius, 0);
      const auto r = static_cast<float>(radius);
      const float corner = fit.mean + r * fit.slope_x + r * fit.slope_y;
      value_squares += static_cast<double>(fit.value * fit.value);
      corner_squares += static_cast<double>(corner * corner);
    }
    EXPECT_NEAR(value_squares / kTrials / static_cast<double>(value_variance(radius)), 1.0, 0.08);
    EXPECT_NEAR(corner_squares / kTrials / static_cast<double>(corner_variance(radius)), 1.0, 0.08);
  }
}

}  // namespace
}  // namespace frangia
