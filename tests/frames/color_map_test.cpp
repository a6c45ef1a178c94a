#include <array>
#include <cstddef>
#include <limits>

#include <gtest/gtest.h>

#include "frangia/frames/map_picture.h"

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

TEST(ColorMap, AgreesWithMatplotlib) {
  // colormaps["viridis"](k / 8) and ["coolwarm"](k / 8) of matplotlib 3.6, which has 256 steps.
  const std::array<Eigen::Vector3f, 9> viridis{{{0.267F, 0.005F, 0.329F},
                                                {0.279F, 0.175F, 0.483F},
                                                {0.230F, 0.322F, 0.546F},
                                                {0.173F, 0.449F, 0.558F},
                                                {0.128F, 0.567F, 0.551F},
                                                {0.158F, 0.684F, 0.502F},
                                                {0.369F, 0.789F, 0.383F},
                                                {0.678F, 0.864F, 0.190F},
                                                {0.993F, 0.906F, 0.144F}}};
  const std::array<Eigen::Vector3f, 9> coolwarm{{{0.230F, 0.299F, 0.754F},
                                                 {0.384F, 0.510F, 0.918F},
                                                 {0.554F, 0.690F, 0.996F},
                                                 {0.724F, 0.815F, 0.976F},
                                                 {0.867F, 0.864F, 0.863F},
                                                 {0.960F, 0.767F, 0.674F},
                                                 {0.957F, 0.598F, 0.477F},
                                                 {0.865F, 0.371F, 0.296F},
                                                 {0.706F, 0.016F, 0.150F}}};
  for (std::size_t k = 0; k < 9; ++k) {
    const float value = static_cast<float>(k) / 8.0F;
    EXPECT_LT((color_of(ColorMap::Viridis, value) - viridis.at(k)).cwiseAbs().maxCoeff(), 0.01F);
    EXPECT_LT((color_of(ColorMap::Diverging, value) - coolwarm.at(k)).cwiseAbs().maxCoeff(), 0.01F);
    if (k == 8) break;
    const Eigen::Vector3f between = 0.75F * viridis.at(k) + 0.25F * viridis.at(k + 1);
    EXPECT_LT((color_of(ColorMap::Viridis, value + 1.0F / 32.0F) - between).norm(), 0.01F);
  }
}

TEST(ColorMap, GrayIsTheValueItself) {
  for (const float value : {0.0F, 0.3F, 1.0F})
    EXPECT_EQ(color_of(ColorMap::Gray, value), Eigen::Vector3f::Constant(value));
  EXPECT_EQ(color_of(ColorMap::Gray, 1.5F), Eigen::Vector3f::Constant(1.0F));
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
