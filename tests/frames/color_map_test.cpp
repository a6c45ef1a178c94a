#include "frangia/frames/color_map.h"

#include <limits>

#include <gtest/gtest.h>

namespace frangia {
namespace {

float luma(const Eigen::Vector3f& color) {
  return color.dot(Eigen::Vector3f(0.2126F, 0.7152F, 0.0722F));
}

TEST(ColorMap, ViridisBrightensMonotonically) {
  for (int i = 0; i < 100; ++i) {
    const auto value = static_cast<float>(i);
    EXPECT_LT(luma(color_of(ColorMap::Viridis, value / 100.0F)),
              luma(color_of(ColorMap::Viridis, (value + 1.0F) / 100.0F)));
  }
}

TEST(ColorMap, DivergingIsBlueBelowGreyAtTheCentreAndRedAbove) {
  const Eigen::Vector3f low = color_of(ColorMap::Diverging, 0.1F);
  const Eigen::Vector3f middle = color_of(ColorMap::Diverging, 0.5F);
  const Eigen::Vector3f high = color_of(ColorMap::Diverging, 0.9F);
  EXPECT_GT(low.z(), low.x());
  EXPECT_NEAR(middle.x(), middle.z(), 1e-5F);
  EXPECT_GT(high.x(), high.z());
}

TEST(ColorMap, ClampsToTheEndsAndShowsNanAsGrey) {
  EXPECT_EQ(color_of(ColorMap::Viridis, -3.0F), color_of(ColorMap::Viridis, 0.0F));
  EXPECT_EQ(color_of(ColorMap::Viridis, 7.0F), color_of(ColorMap::Viridis, 1.0F));
  const Eigen::Vector3f grey = color_of(ColorMap::Viridis, std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(grey.x(), grey.y());
  EXPECT_EQ(grey.y(), grey.z());
}

}  // namespace
}  // namespace frangia
