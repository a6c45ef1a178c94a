// The systematic part of a phase and of points while their fringe orders are resolved and
// corrected.
#include <cmath>

#include <gtest/gtest.h>

#include "frangia/fringe_order/correct_fringe_orders.h"
#include "frangia/fringe_order/resolve_by_views.h"

#include "fringe_order/ball_views.h"

namespace frangia {
namespace {

using testing::Ball;
using testing::kBallPattern;

/// Gives each point of a view a systematic part of twice its sigma.
void add_systematic(View& view) {
  view.range.systematic_mm = view.range.sigma_mm;
  for (float& systematic : view.range.systematic_mm.pixels())
    systematic *= 2.0F;
}

void expect_twice_sigma(const View& view, std::size_t least) {
  std::size_t points = 0;
  for (std::size_t i = 0; i < view.range.depth_mm.pixels().size(); ++i) {
    const float systematic = view.range.systematic_mm.pixels()[i];
    if (std::isnan(view.range.depth_mm.pixels()[i])) {
      EXPECT_TRUE(std::isnan(systematic));
      continue;
    }
    ++points;
    ASSERT_FLOAT_EQ(systematic, 2.0F * view.range.sigma_mm.pixels()[i]);
  }
  EXPECT_GT(points, least);
}

TEST(SystematicPart, OfARegionThatOtherViewsResolveIsTriangulatedWithIt) {
  const Ball ball;
  ViewStore views;
  UnresolvedViewRegion unresolved;
  for (int i = 0; i < 6; ++i) {
    View view = ball.view(kTwoPi * i / 6.0);
    add_systematic(view);
    if (i == 2) {
      unresolved = ball.make_unresolved(view, 2, 3);
      unresolved.region.systematic_rad.assign(unresolved.region.pixel.size(), 0.04F);
    }
    views.add(view);
  }
  const auto result = resolve_by_views(views, {unresolved}, {kBallPattern, ball.rig, ball.rays});
  EXPECT_EQ(result.removed_points, 0U);
  expect_twice_sigma(views.load(2), 5000);  // the region's sigma is 0.02 rad
}

TEST(SystematicPart, OfCorrectedPointsChangesAsTheirNoise) {
  const Ball ball;
  ViewStore views;
  for (int i = 0; i < 6; ++i) {
    View view = ball.view(kTwoPi * i / 6.0);
    if (i == 2) {
      for (int y = 0; y < 160; ++y) {
        for (int x = 0; x < 80; ++x) {
          RangePixel pixel = view.range.pixel(x, y);
          if (std::isnan(pixel.depth_mm)) continue;
          pixel.phase_rad = static_cast<float>(pixel.phase_rad + kTwoPi);
          pixel.depth_mm = ball.depth_at(static_cast<std::size_t>(y * 160 + x), pixel.phase_rad);
          view.range.set(pixel);
        }
      }
    }
    add_systematic(view);
    views.add(view);
  }
  EXPECT_GT(correct_fringe_orders(views, {kBallPattern, ball.rig, ball.rays}), 800U);
  expect_twice_sigma(views.load(2), 5000);
}

}  // namespace
}  // namespace frangia
