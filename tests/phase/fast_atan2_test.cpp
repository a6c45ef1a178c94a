#include "frangia/phase/internal/fast_atan2.h"

#include <cmath>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"

namespace frangia {
namespace {

TEST(FastAtan2, IsExactToLessThanAMillionthOfARadian) {
  constexpr int kAngles = 100000;
  for (const float radius : {1e-3F, 1.0F, 6e4F}) {
    for (int i = 0; i < kAngles; ++i) {
      const double angle = kTwoPi * (i + 0.5) / kAngles - kPi;
      const float y = radius * static_cast<float>(std::sin(angle));
      const float x = radius * static_cast<float>(std::cos(angle));
      const double exact = std::atan2(static_cast<double>(y), static_cast<double>(x));
      ASSERT_NEAR(wrap_rad(static_cast<double>(fast_atan2(y, x)) - exact), 0.0, 6e-7) << angle;
    }
  }
}

TEST(FastAtan2, IsFiniteWithoutModulation) {
  EXPECT_TRUE(std::isfinite(fast_atan2(0.0F, 0.0F)));
}

}  // namespace
}  // namespace frangia
