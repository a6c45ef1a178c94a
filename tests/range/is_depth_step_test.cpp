#include <gtest/gtest.h>

#include "frangia/core/missing.h"
#include "frangia/range/internal/pixel_connections.h"

namespace frangia {
namespace {

TEST(IsDepthStep, DistinguishesAJumpFromASlopeAndACrease) {
  EXPECT_TRUE(is_depth_step({2.0F, 0.1F, 0.1F}, 1.0F));
  EXPECT_TRUE(is_depth_step({-2.0F, 0.1F, 0.1F}, 1.0F));
  EXPECT_FALSE(is_depth_step({2.0F, 2.0F, 2.0F}, 1.0F));  // a slope
  EXPECT_FALSE(is_depth_step({2.0F, 0.0F, 2.0F}, 0.5F));  // a crease
}

TEST(IsDepthStep, ExceedsTheMinimumHeight) {
  EXPECT_FALSE(is_depth_step({0.9F, 0.0F, 0.0F}, 1.0F));
  EXPECT_TRUE(is_depth_step({1.1F, 0.0F, 0.0F}, 1.0F));
}

TEST(IsDepthStep, IsFalseWhereASideIsMissing) {
  EXPECT_FALSE(is_depth_step({2.0F, kMissing, 0.1F}, 1.0F));
  EXPECT_FALSE(is_depth_step({2.0F, 0.1F, kMissing}, 1.0F));
  EXPECT_FALSE(is_depth_step({kMissing, 0.1F, 0.1F}, 1.0F));
}

}  // namespace
}  // namespace frangia
