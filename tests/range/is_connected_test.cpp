#include <gtest/gtest.h>

#include "frangia/core/missing.h"
#include "frangia/range/internal/pixel_connections.h"

namespace frangia {
namespace {

/// Two neighbours at a lateral distance of 1 mm.
bool connected(float one_mm, float other_mm, float sigma_mm) {
  RangeGrid range{Image<float>(2, 1, one_mm), Image<float>(2, 1, sigma_mm)};
  range.depth_mm(1, 0) = other_mm;
  Image<Eigen::Vector2f> rays(2, 1, Eigen::Vector2f::Zero());
  rays(1, 0).x() = 2.0F / (one_mm + other_mm);
  return is_connected(range, rays, {0, 0}, {1, 0}, 7.0F);
}

TEST(IsConnected, HoldsUpToTheMaximumSlope) {
  EXPECT_TRUE(connected(500.0F, 506.9F, 0.0F));
  EXPECT_FALSE(connected(500.0F, 507.1F, 0.0F));
}

TEST(IsConnected, AllowsForNoise) {
  EXPECT_TRUE(connected(500.0F, 507.5F, 0.1F));
  EXPECT_FALSE(connected(500.0F, 507.6F, 0.1F));
}

TEST(IsConnected, IsFalseWhereAPixelIsMissing) {
  EXPECT_FALSE(connected(500.0F, kMissing, 0.1F));
}

}  // namespace
}  // namespace frangia
