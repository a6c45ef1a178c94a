#include <gtest/gtest.h>

#include "frangia/core/missing.h"
#include "frangia/range/measured_volume.h"

namespace frangia {
namespace {

TEST(MeasuredBox, HoldsEveryPixelWithAValue) {
  Image<float> image(40, 30, kMissing);
  image(7, 12) = 1.0F;
  image(31, 5) = 0.0F;
  image(20, 28) = -1.0F;
  const PixelBox box = measured_box(image);
  EXPECT_EQ(box.left, 7);
  EXPECT_EQ(box.right, 32);
  EXPECT_EQ(box.top, 5);
  EXPECT_EQ(box.bottom, 29);
}

TEST(MeasuredBox, IsEmptyWithoutValues) {
  EXPECT_TRUE(measured_box(Image<float>(40, 30, kMissing)).empty());
  EXPECT_TRUE(measured_box(Image<float>()).empty());
}

TEST(MeasuredBox, GrowsWithinTheImage) {
  const PixelBox box = grow({2, 10, 38, 20}, 4, 40, 30);
  EXPECT_EQ(box.left, 0);
  EXPECT_EQ(box.right, 40);
  EXPECT_EQ(box.top, 6);
  EXPECT_EQ(box.bottom, 24);
  EXPECT_TRUE(grow({0, 0, 0, 0}, 4, 40, 30).empty());
}

}  // namespace
}  // namespace frangia
