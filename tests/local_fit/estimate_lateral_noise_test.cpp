#include "frangia/local_fit/internal/estimate_lateral_noise.h"

#include <random>

#include <gtest/gtest.h>

namespace frangia {
namespace {

/// A ball's cap whose pixels have lateral localization noise and noise of their value.
Image<float> cap(float lateral_noise_px, float noise) {
  constexpr int kSide = 200;
  constexpr int kHalf = kSide / 2;
  std::mt19937 random(3);
  std::normal_distribution<float> normal;
  Image<float> image(kSide, kSide);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const float dx = static_cast<float>(x - kHalf) + lateral_noise_px * normal(random);
      const float dy = static_cast<float>(y - kHalf) + lateral_noise_px * normal(random);
      image(x, y) = 300.0F - (dx * dx + dy * dy) / 300.0F + noise * normal(random);
    }
  }
  return image;
}

TEST(EstimateLateralNoise, FindsTheOffsetOfPixelsFromTheirCenters) {
  constexpr float kNoise = 0.02F;
  const Image<float> noise(200, 200, kNoise);
  EXPECT_NEAR(estimate_lateral_noise(cap(0.1F, kNoise), noise), 0.1F, 0.01F);
  EXPECT_NEAR(estimate_lateral_noise(cap(0.3F, kNoise), noise), 0.3F, 0.03F);
}

TEST(EstimateLateralNoise, DistinguishesItFromNoise) {
  constexpr float kNoise = 0.05F;
  EXPECT_LT(estimate_lateral_noise(cap(0.0F, kNoise), Image<float>(200, 200, kNoise)), 0.02F);
}

TEST(EstimateLateralNoise, IsZeroForTooFewPixels) {
  EXPECT_EQ(estimate_lateral_noise(Image<float>(8, 8, 1.0F), Image<float>(8, 8, 1.0F)), 0.0F);
}

}  // namespace
}  // namespace frangia
