#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "frangia/local_fit/fit_windows.h"

namespace frangia {
namespace {

constexpr float kPixelNoise = 0.01F;
constexpr int kSize = 21;
constexpr int kMiddle = 10;

/// An image of `value(dx, dy)` about its middle with noise.
template <typename Value>
Image<float> image_of(const Value& value, std::uint32_t seed = 1) {
  std::mt19937 random(seed);
  std::normal_distribution<float> normal;
  Image<float> image(kSize, kSize);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      image(x, y) = value(static_cast<float>(x - kMiddle), static_cast<float>(y - kMiddle)) +
                    kPixelNoise * normal(random);
    }
  }
  return image;
}

ChosenWindow choose(const Image<float>& image, int x = kMiddle) {
  const WindowRows fits(image, 2, kMiddle, 1);
  return choose_window(image, fits, {x, kMiddle}, {.value = kPixelNoise});
}

TEST(ChooseWindow, IsCenteredOnAPlane) {
  double squares = 0.0;
  double predicted = 0.0;
  for (std::uint32_t seed = 0; seed < 400; ++seed) {
    const auto image = image_of([](float x, float y) { return 5.0F + 0.3F * x - 0.2F * y; }, seed);
    const ChosenWindow chosen = choose(image);
    ASSERT_EQ(chosen.kind, WindowKind::Centered);
    EXPECT_NEAR(chosen.fit.slope_x, 0.3F, 0.01F);
    EXPECT_NEAR(chosen.fit.slope_y, -0.2F, 0.01F);
    squares += std::pow(chosen.value - 5.0, 2);
    predicted += static_cast<double>(chosen.variance);
  }
  EXPECT_NEAR(squares / predicted, 1.0, 0.2);
}

TEST(ChooseWindow, IsCenteredOnACurvedSurface) {
  const auto image =
      image_of([](float x, float y) { return 5.0F + 0.05F * x * x - 0.03F * x * y; });
  const ChosenWindow chosen = choose(image);
  EXPECT_EQ(chosen.kind, WindowKind::Centered);
  EXPECT_NEAR(chosen.value, 5.0F, 3.0F * kPixelNoise);
}

TEST(ChooseWindow, LiesOnOneSideOfAnEdge) {
  // Two faces that meet between the columns 10 and 11.
  const auto image = image_of([](float x, float) { return std::abs(x - 0.5F); });
  for (const int x : {kMiddle - 1, kMiddle, kMiddle + 1, kMiddle + 2}) {
    const ChosenWindow chosen = choose(image, x);
    ASSERT_NE(chosen.kind, WindowKind::None) << x;
    EXPECT_NEAR(chosen.fit.slope_x, x <= kMiddle ? -1.0F : 1.0F, 0.02F) << x;
    EXPECT_NEAR(chosen.value, image(x, kMiddle), 4.0F * kPixelNoise) << x;
  }
}

TEST(ChooseWindow, IsMissingAtASinglePixelOffTheSurface) {
  auto image = image_of([](float, float) { return 5.0F; });
  image(kMiddle, kMiddle) += 100.0F * kPixelNoise;
  const ChosenWindow chosen = choose(image);
  EXPECT_EQ(chosen.kind, WindowKind::None);
  EXPECT_TRUE(std::isnan(chosen.value));
}

TEST(PixelNoise, AddsLateralNoiseWithTheSlope) {
  WindowFit fit;
  fit.slope_x = 3.0F;
  fit.slope_y = 4.0F;
  EXPECT_NEAR((PixelNoise{0.5F, 0.1F}.variance(fit)), 0.25F + 0.25F, 1e-6F);
}

}  // namespace
}  // namespace frangia
