#include "frangia/fringe_order/resolve_by_views.h"

#include <cmath>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"

#include "fringe_order/ball_views.h"

namespace frangia {
namespace {

using testing::Ball;
using testing::kBallPattern;

TEST(ResolveByViews, FindsTheOrderAtWhichOtherViewsConfirmARegion) {
  const Ball ball;
  ViewStore views;
  std::vector<UnresolvedViewRegion> unresolved;
  for (int i = 0; i < 6; ++i) {
    View view = ball.view(kTwoPi * i / 6.0);
    if (i == 2) unresolved.push_back(ball.make_unresolved(view, 2, 4));
    views.add(view);
  }
  const auto result = resolve_by_views(views, unresolved, {kBallPattern, ball.rig, ball.rays});
  EXPECT_EQ(result.removed_points, 0U);
  EXPECT_EQ(result.resolved_points, unresolved[0].region.pixel.size());
  const View resolved = views.load(2);
  const View truth = ball.view(kTwoPi * 2 / 6.0);
  for (std::size_t i = 0; i < truth.range.depth_mm.pixels().size(); ++i) {
    const float depth = truth.range.depth_mm.pixels()[i];
    if (std::isnan(depth)) continue;
    EXPECT_NEAR(resolved.range.depth_mm.pixels()[i], depth, 0.01);
    const float phase = resolved.range.phase_rad.pixels()[i];
    EXPECT_NEAR(phase, truth.range.phase_rad.pixels()[i], 1e-5);
    EXPECT_EQ(resolved.range.depth_mm.pixels()[i], ball.depth_at(i, phase));
    // Sigma is along the ray: the way between the points of a phase one sigma more and less.
    constexpr float kSigma_rad = 0.02F;
    const float apart_mm =
        ball.depth_at(i, phase + kSigma_rad) - ball.depth_at(i, phase - kSigma_rad);
    const float sigma_mm = 0.5F * std::abs(apart_mm) * ball.rays.pixels()[i].homogeneous().norm();
    EXPECT_NEAR(resolved.range.sigma_mm.pixels()[i] / sigma_mm, 1.0, 0.004);
  }
}

TEST(ResolveByViews, RemovesWhatNoOtherViewConfirms) {
  const Ball ball;
  ViewStore views;
  View only = ball.view(0.0);
  const std::vector<UnresolvedViewRegion> unresolved = {ball.make_unresolved(only, 0, 1)};
  views.add(only);
  const auto result = resolve_by_views(views, unresolved, {kBallPattern, ball.rig, ball.rays});
  EXPECT_EQ(result.resolved_points, 0U);
  EXPECT_EQ(result.removed_points, unresolved[0].region.pixel.size());
}

TEST(ResolveByViews, DoesNothingWithoutUnresolvedRegions) {
  const Ball ball;
  ViewStore views;
  views.add(ball.view(0.0));
  const auto result = resolve_by_views(views, {}, {kBallPattern, ball.rig, ball.rays});
  EXPECT_EQ(result.resolved_points + result.removed_points, 0U);
}

}  // namespace
}  // namespace frangia
