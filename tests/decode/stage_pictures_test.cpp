#include "frangia/decode/stage_pictures.h"

#include <cmath>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/missing.h"

namespace frangia {
namespace {

TEST(StatusLegend, HasARowForEachStatusInTheirOrderWithAColorOfItsOwn) {
  const auto& legend = status_legend();
  ASSERT_EQ(legend.size(), static_cast<std::size_t>(PixelStatus::Contradicting) + 1);
  for (std::size_t i = 0; i < legend.size(); ++i) {
    EXPECT_EQ(legend[i].status, static_cast<PixelStatus>(i));
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_NE(legend[i].color, legend[j].color);
  }
}

TEST(StatusPicture, ShowsTheStatusOfEachPixel) {
  Image<PixelStatus> status(3, 1, PixelStatus::Measured);
  status(1, 0) = PixelStatus::Saturated;
  status(2, 0) = PixelStatus::Residue;
  const Image<Rgb> picture = status_picture(status);
  for (int x = 0; x < 3; ++x)
    EXPECT_EQ(picture(x, 0), status_legend()[static_cast<std::size_t>(status(x, 0))].color);
}

TEST(ResiduePicture, MarksLoopsBySenseAndIsTheGreyPhaseElsewhere) {
  Image<float> wrapped(41, 41);
  for (int y = 0; y < 41; ++y) {
    for (int x = 0; x < 41; ++x)
      wrapped(x, y) = static_cast<float>(std::atan2(y - 20.5, x - 20.5));
  }
  const Image<Rgb> gained = residue_picture(wrapped);
  EXPECT_GT(gained(20, 20)[0], gained(20, 20)[2]);  // red
  EXPECT_EQ(gained(21, 21), gained(20, 20));
  for (float& rad : wrapped.pixels())
    rad = -rad;
  const Image<Rgb> lost = residue_picture(wrapped);
  EXPECT_LT(lost(20, 20)[0], lost(20, 20)[2]);  // blue
  // -pi is black, +pi white, and grey has three equal parts.
  const Rgb grey = lost(40, 20);
  EXPECT_EQ(grey[0], grey[1]);
  EXPECT_NEAR(grey[0], 255.0 * (wrapped(40, 20) + kPi) / kTwoPi, 1.0);
}

TEST(GrowthPicture, GoesFromDarkBlueToYellowAndLeavesMissingPixelsDark) {
  Image<std::int32_t> order(3, 1, -1);
  order(0, 0) = 0;
  order(2, 0) = 1;
  const Image<Rgb> picture = growth_picture(order);
  EXPECT_LT(picture(0, 0)[1], 30);   // the dark end of viridis
  EXPECT_GT(picture(2, 0)[1], 220);  // its yellow end
  EXPECT_EQ(picture(1, 0),
            status_legend()[static_cast<std::size_t>(PixelStatus::Unmodulated)].color);
}

TEST(FringeOrders, CountWholeTurnsFromTheLowestFringe) {
  Image<float> absolute(200, 1);
  Image<float> wrapped(200, 1);
  for (int x = 0; x < 200; ++x) {
    absolute(x, 0) = static_cast<float>(-20.0 + 0.31 * x);
    wrapped(x, 0) = static_cast<float>(wrap_rad(absolute(x, 0)));
  }
  absolute(7, 0) = kMissing;
  wrapped(9, 0) = kMissing;
  const auto number = fringe_orders(wrapped, absolute);
  EXPECT_EQ(number(7, 0), -1);
  EXPECT_EQ(number(9, 0), -1);
  for (int x = 10; x < 200; ++x) {
    const double turns = (absolute(x, 0) - wrapped(x, 0)) / kTwoPi;
    EXPECT_EQ(number(x, 0), static_cast<int>(std::lround(turns)) + 3);  // -20 rad is fringe -3
  }
}

}  // namespace
}  // namespace frangia
