#include "frangia/fringe_order/correct_fringe_orders.h"

#include <cmath>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"

#include "fringe_order/ball_views.h"

namespace frangia {
namespace {

using testing::Ball;
using testing::kBallPattern;

/// Gives the part of a view left of a column an order that is `fringes` too high.
void shift_left_part(const Ball& ball, View& view, int column, int fringes) {
  for (int y = 0; y < view.range.depth_mm.height(); ++y) {
    for (int x = 0; x < column; ++x) {
      RangePixel pixel = view.range.pixel(x, y);
      if (std::isnan(pixel.depth_mm)) continue;
      pixel.phase_rad = static_cast<float>(pixel.phase_rad + kTwoPi * fringes);
      pixel.depth_mm = ball.depth_at(static_cast<std::size_t>(y * 160 + x), pixel.phase_rad);
      view.range.set(pixel);
    }
  }
}

ViewStore six_views(const Ball& ball, int fringes) {
  ViewStore views;
  for (int i = 0; i < 6; ++i) {
    View view = ball.view(kTwoPi * i / 6.0);
    if (i == 2) shift_left_part(ball, view, 80, fringes);
    views.add(view);
  }
  return views;
}

TEST(CorrectFringeOrders, CorrectsThePartOfAViewThatIsWholeFringesOff) {
  const Ball ball;
  for (const int fringes : {1, -1, 2}) {
    ViewStore views = six_views(ball, fringes);
    EXPECT_GT(correct_fringe_orders(views, {kBallPattern, ball.rig, ball.rays}), 800U);
    const View corrected = views.load(2);
    const View truth = ball.view(kTwoPi * 2 / 6.0);
    int off = 0;
    int kept = 0;
    for (std::size_t i = 0; i < truth.range.depth_mm.pixels().size(); ++i) {
      const float depth = corrected.range.depth_mm.pixels()[i];
      if (std::isnan(depth)) continue;
      ++kept;
      off += std::abs(depth - truth.range.depth_mm.pixels()[i]) > 1.0F ? 1 : 0;
    }
    EXPECT_GT(kept, 5000) << fringes;
    EXPECT_LT(off, kept / 20) << fringes;
  }
}

TEST(CorrectFringeOrders, RemovesMixedPixelsByTheGivenCriteria) {
  const Ball ball;
  ViewStore views = six_views(ball, 1);
  FringeOrderCorrectionOptions options;
  options.mixed_pixels.min_patch_px = 160 * 120;  // larger than any patch: nothing is kept
  ASSERT_GT(correct_fringe_orders(views, {kBallPattern, ball.rig, ball.rays}, options), 800U);
  const View corrected = views.load(2);
  for (const float depth : corrected.range.depth_mm.pixels())
    ASSERT_TRUE(std::isnan(depth));
}

TEST(CorrectFringeOrders, CorrectsThePhaseAndTriangulatesItWithoutLoss) {
  const Ball ball;
  ViewStore views = six_views(ball, 1);
  ASSERT_GT(correct_fringe_orders(views, {kBallPattern, ball.rig, ball.rays}), 800U);
  const View corrected = views.load(2);
  const View truth = ball.view(kTwoPi * 2 / 6.0);
  int changed = 0;
  for (int y = 0; y < 160; ++y) {
    for (int x = 0; x < 80; ++x) {
      const RangePixel pixel = corrected.range.pixel(x, y);
      ASSERT_EQ(std::isnan(pixel.depth_mm), std::isnan(pixel.phase_rad));
      if (!(std::abs(pixel.depth_mm - truth.range.depth_mm(x, y)) < 1.0F)) continue;
      ++changed;
      ASSERT_NEAR(pixel.phase_rad, truth.range.phase_rad(x, y), 1e-5);
      // A phase computed back from the depth would differ in its last digits.
      ASSERT_EQ(pixel.depth_mm,
                ball.depth_at(static_cast<std::size_t>(y * 160 + x), pixel.phase_rad));
    }
  }
  EXPECT_GT(changed, 800);
}

TEST(CorrectFringeOrders, LeavesAViewWithoutPhaseUnchanged) {
  const Ball ball;
  const ViewStore with_phase = six_views(ball, 1);
  ViewStore views;
  for (std::size_t i = 0; i < 6; ++i)
    views.add(with_phase.load_points(i));
  EXPECT_EQ(correct_fringe_orders(views, {kBallPattern, ball.rig, ball.rays}), 0U);
}

TEST(CorrectFringeOrders, LeavesConsistentViewsUnchanged) {
  const Ball ball;
  ViewStore views = six_views(ball, 0);
  const View before = views.load(2);
  EXPECT_EQ(correct_fringe_orders(views, {kBallPattern, ball.rig, ball.rays}), 0U);
  const View after = views.load(2);
  for (std::size_t i = 0; i < before.range.depth_mm.pixels().size(); ++i) {
    const float a = before.range.depth_mm.pixels()[i];
    const float b = after.range.depth_mm.pixels()[i];
    EXPECT_TRUE(a == b || (std::isnan(a) && std::isnan(b)));
  }
}

TEST(CorrectFringeOrders, LeavesASingleViewUnchanged) {
  const Ball ball;
  ViewStore views;
  views.add(ball.view(0.0));
  EXPECT_EQ(correct_fringe_orders(views, {kBallPattern, ball.rig, ball.rays}), 0U);
}

}  // namespace
}  // namespace frangia
