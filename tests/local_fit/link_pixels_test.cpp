#include "frangia/local_fit/internal/link_pixels.h"

#include <cmath>

#include <gtest/gtest.h>

#include "frangia/core/missing.h"

namespace frangia {
namespace {

/// Two pixels side by side that are 0.5 mm apart at 500 mm.
LinkedPixels pair(float one_mm, float other_mm, float sigma_mm) {
  RangeGrid range{Image<float>(2, 1, one_mm), Image<float>(2, 1, sigma_mm)};
  range.depth_mm(1, 0) = other_mm;
  return link_pixels(
      range, {.width_px = 2, .height_px = 1, .focal_px = {1000.0, 1000.0}, .distortion = {}});
}

TEST(LinkPixels, LinksUpToASlopeOf82Degrees) {
  // The tangent of 82 degrees is 7.1: 3.55 mm.
  EXPECT_TRUE(pair(500.0F, 503.4F, 0.0F).has(0, 0, LinkedPixels::Right));
  EXPECT_FALSE(pair(500.0F, 503.8F, 0.0F).has(0, 0, LinkedPixels::Right));
}

TEST(LinkPixels, AllowsForNoise) {
  EXPECT_TRUE(pair(500.0F, 503.8F, 0.1F).has(0, 0, LinkedPixels::Right));
  EXPECT_FALSE(pair(500.0F, 504.2F, 0.1F).has(0, 0, LinkedPixels::Right));
}

TEST(LinkPixels, DoesNotLinkMissingPixels) {
  const LinkedPixels linked = pair(500.0F, kMissing, 0.1F);
  EXPECT_FALSE(linked.has(0, 0, LinkedPixels::Right));
  EXPECT_TRUE(std::isnan(linked.q(1, 0)));
  EXPECT_NEAR(linked.q(0, 0), 1.0F / 500.0F, 1e-9F);
  EXPECT_NEAR(linked.noise(0, 0), 0.1F / (500.0F * 500.0F), 1e-10F);
}

}  // namespace
}  // namespace frangia
