#include "frangia/simulate/place_stickers.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "frangia/core/error.h"
#include "frangia/simulate/parts.h"

namespace frangia {
namespace {

const TargetSet kSet{.diameter_mm = 4.0, .dictionary = "DICT_4X4_50", .marker_mm = 8.0};

TEST(PlaceStickers, LiesFlatOnTheFacesOfAPlateAndApart) {
  const auto stickers = place_stickers(make_plate(), kSet, 8, 3, 1);
  ASSERT_EQ(stickers.size(), 11U);
  for (std::size_t i = 0; i < stickers.size(); ++i) {
    const Sticker& one = stickers[i];
    EXPECT_EQ(one.code, i < 8 ? -1 : static_cast<int>(i) - 8);
    // The plate is 80 x 60 x 6, upright on the axis.
    const double room = one.code < 0 ? 2.0 : 5.65;
    const Eigen::Vector3d away = one.center_mm - Eigen::Vector3d(0.0, 0.0, 30.0);
    const Eigen::Vector3d half(3.0, 40.0, 30.0);
    for (Eigen::Index k = 0; k < 3; ++k) {
      const bool across = std::abs(one.normal[k]) > 0.5;
      EXPECT_NEAR(
          std::abs(away[k]), across ? half[k] : std::min(std::abs(away[k]), half[k] - room), 1e-4);
    }
    EXPECT_NEAR(one.right.dot(one.normal), 0.0, 1e-9);
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GT((one.center_mm - stickers[j].center_mm).norm(), 11.0);
  }
}

TEST(PlaceStickers, RefusesMoreThanThePartHasRoomFor) {
  EXPECT_THROW(static_cast<void>(place_stickers(make_plate(), kSet, 600, 0, 1)), Error);
}

TEST(StickerAlbedo, IsInkOnPaperAndNothingBesideIt) {
  const std::vector<Sticker> one = {{}};
  TargetSet set{.diameter_mm = 4.0};
  set.sticker_mm = 8.0;
  EXPECT_LT(sticker_albedo(set, one, {1.0, 1.0, 0.0}), 0.2);
  EXPECT_GT(sticker_albedo(set, one, {3.0, 0.0, 0.0}), 0.8);
  EXPECT_TRUE(std::isnan(sticker_albedo(set, one, {4.5, 0.0, 0.0})));
  EXPECT_TRUE(std::isnan(sticker_albedo(set, one, {0.0, 0.0, -6.0})));
}

}  // namespace
}  // namespace frangia
