#include "frangia/fringe_order/correct_fringe_orders.h"

#include <cmath>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/missing.h"
#include "frangia/range/fringe_ray.h"

#include "fringe_order/ball_views.h"

namespace frangia {
namespace {

using testing::Ball;
using testing::kBallPattern;

/// The part of a view left of a column, as it would be with `fringes` too many.
void shift_left_part(const Ball& ball, View& view, int column, int fringes) {
  for (int y = 0; y < view.range.depth_mm.height(); ++y) {
    for (int x = 0; x < column; ++x) {
      float& depth = view.range.depth_mm(x, y);
      if (std::isnan(depth)) continue;
      const Eigen::Vector2d ray = ball.rays(x, y).cast<double>();
      const Eigen::Vector3d point = depth * Eigen::Vector3d(ray.x(), ray.y(), 1.0);
      const double phase = phase_at(point, kBallPattern, ball.rig.projector) + kTwoPi * fringes;
      depth = static_cast<float>(
          intersect_fringe(ray, phase, kBallPattern, ball.rig.projector).depth_mm);
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

TEST(CorrectFringeOrders, MovesThePartOfAViewThatIsWholeFringesOff) {
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

TEST(CorrectFringeOrders, LeavesViewsAloneThatAgree) {
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

TEST(CorrectFringeOrders, LeavesAViewAloneThatNoOtherOverlaps) {
  const Ball ball;
  ViewStore views;
  views.add(ball.view(0.0));
  EXPECT_EQ(correct_fringe_orders(views, {kBallPattern, ball.rig, ball.rays}), 0U);
}

}  // namespace
}  // namespace frangia
