#include "frangia/range/range_grid.h"

#include <cmath>

#include <gtest/gtest.h>

namespace frangia {
namespace {

TEST(RangeGrid, SetsAndRemovesAllValuesOfAPixelTogether) {
  const Image<float> missing(3, 2, kMissing);
  RangeGrid grid{missing, missing, missing};
  grid.set({2, 1, 500.0F, 0.1F, 7.0F});
  const RangePixel pixel = grid.pixel(2, 1);
  EXPECT_EQ(pixel.depth_mm, 500.0F);
  EXPECT_EQ(pixel.sigma_mm, 0.1F);
  EXPECT_EQ(pixel.phase_rad, 7.0F);
  EXPECT_TRUE(std::isnan(grid.depth_mm(1, 1)));
  grid.remove(2, 1);
  EXPECT_TRUE(std::isnan(grid.depth_mm(2, 1)));
  EXPECT_TRUE(std::isnan(grid.sigma_mm(2, 1)));
  EXPECT_TRUE(std::isnan(grid.phase_rad(2, 1)));
}

TEST(RangeGrid, MayHaveNoPhase) {
  RangeGrid grid{Image<float>(3, 2, kMissing), Image<float>(3, 2, kMissing)};
  grid.set({2, 1, 500.0F, 0.1F, 7.0F});
  EXPECT_EQ(grid.pixel(2, 1).depth_mm, 500.0F);
  EXPECT_TRUE(std::isnan(grid.pixel(2, 1).phase_rad));
}

}  // namespace
}  // namespace frangia
