#include "frangia/views/anchor_by_views.h"

#include <cmath>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"

#include "views/ball_views.h"

namespace frangia {
namespace {

using testing::Ball;
using testing::kBallPattern;

TEST(AnchorByViews, PutsALooseRegionWhereItsNeighboursSawIt) {
  const Ball ball;
  ViewStore views;
  std::vector<LoosePart> loose;
  for (int i = 0; i < 6; ++i) {
    View view = ball.view(kTurn * i / 6.0);
    if (i == 2) loose.push_back(ball.loosen(view, 2, 4));
    views.add(view);
  }
  const auto result = anchor_by_views(views, loose, {kBallPattern, ball.rig, ball.rays});
  EXPECT_EQ(result.dropped_points, 0U);
  EXPECT_EQ(result.anchored_points, loose[0].region.pixel.size());
  const View anchored = views.load(2);
  const View truth = ball.view(kTurn * 2 / 6.0);
  for (std::size_t i = 0; i < truth.range.depth_mm.pixels().size(); ++i) {
    const float depth = truth.range.depth_mm.pixels()[i];
    if (std::isnan(depth)) continue;
    EXPECT_NEAR(anchored.range.depth_mm.pixels()[i], depth, 0.01);
  }
}

TEST(AnchorByViews, DropsWhatNoOtherViewConfirms) {
  const Ball ball;
  ViewStore views;
  View only = ball.view(0.0);
  const std::vector<LoosePart> loose = {ball.loosen(only, 0, 1)};
  views.add(only);
  const auto result = anchor_by_views(views, loose, {kBallPattern, ball.rig, ball.rays});
  EXPECT_EQ(result.anchored_points, 0U);
  EXPECT_EQ(result.dropped_points, loose[0].region.pixel.size());
}

TEST(AnchorByViews, HasNothingToDoWithoutLooseRegions) {
  const Ball ball;
  ViewStore views;
  views.add(ball.view(0.0));
  const auto result = anchor_by_views(views, {}, {kBallPattern, ball.rig, ball.rays});
  EXPECT_EQ(result.anchored_points + result.dropped_points, 0U);
}

}  // namespace
}  // namespace frangia
