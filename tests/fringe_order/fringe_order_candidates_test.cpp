#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/fringe_order/resolve_by_views.h"

#include "fringe_order/ball_views.h"

namespace frangia {
namespace {

using testing::Ball;
using testing::kBallPattern;

/// The phases of one view of the ball, `fringes` too low.
FringePixels pixels_of(const Ball& ball, const View& view, int fringes) {
  FringePixels pixels;
  for (std::size_t i = 0; i < ball.rays.pixels().size(); ++i) {
    const float phase = view.range.phase_rad.pixels()[i];
    if (std::isnan(phase)) continue;
    pixels.pixel.push_back(static_cast<std::uint32_t>(i));
    pixels.phase_rad.push_back(static_cast<float>(phase - kTwoPi * fringes));
  }
  return pixels;
}

TEST(FringeOrderCandidates, HoldTheTrueSurfaceAtTheTrueOrder) {
  const Ball ball;
  const View view = ball.view(0.7);
  const FringeComparison comparison{{kBallPattern, ball.rig, ball.rays}};
  const auto candidates =
      fringe_order_candidates(pixels_of(ball, view, 3), view.rig_from_object, comparison);
  ASSERT_GT(candidates.size(), 3U);
  bool found = false;
  for (const FringeOrderCandidate& candidate : candidates) {
    EXPECT_LE(candidate.points_mm.size(), 2U * 400U);
    if (candidate.order != 3) continue;
    found = true;
    for (const Eigen::Vector3f& point : candidate.points_mm)
      EXPECT_NEAR(point.norm(), ball.radius_mm, 0.01);
  }
  EXPECT_TRUE(found);
}

TEST(FringeOrderCandidates, AreOneSpacingApart) {
  const Ball ball;
  const View view = ball.view(0.0);
  const FringeComparison comparison{{kBallPattern, ball.rig, ball.rays}};
  const auto center = static_cast<std::uint32_t>(80 * 160 + 80);
  const FringePixels pixels{{center}, {view.range.phase_rad(80, 80)}};
  const auto candidates = fringe_order_candidates(pixels, view.rig_from_object, comparison);
  for (std::size_t i = 1; i < candidates.size(); ++i) {
    ASSERT_EQ(candidates[i].order, candidates[i - 1].order + 1);
    const double apart_mm = (candidates[i].points_mm[0] - candidates[i - 1].points_mm[0]).norm();
    const double spacing_mm = 0.5 * (candidates[i].spacing_mm + candidates[i - 1].spacing_mm);
    EXPECT_NEAR(apart_mm / spacing_mm, 1.0, 0.02);
  }
}

TEST(FringeOrderCandidates, AreNoneOfNoPixels) {
  const Ball ball;
  const FringeComparison comparison{{kBallPattern, ball.rig, ball.rays}};
  EXPECT_TRUE(fringe_order_candidates({}, Eigen::Isometry3d::Identity(), comparison).empty());
}

TEST(CompareWith, CountsAgreementViolationsAndUnseenPoints) {
  const Ball ball;
  const FringeComparison comparison{{kBallPattern, ball.rig, ball.rays}, 0.1};
  Image<float> depth(160, 160, 500.0F);
  for (int y = 0; y < 80; ++y) {
    for (int x = 0; x < 160; ++x)
      depth(x, y) = kMissing;
  }
  // A tolerance of 1 mm: points at, 1.5 mm in front of, 3 mm in front of and 3 mm behind the wall.
  FringeOrderCandidate candidate{.spacing_mm = 10.0};
  for (const float z : {500.0F, 498.5F, 497.0F, 503.0F})
    candidate.points_mm.emplace_back(0.0F, 20.0F, z);
  candidate.points_mm.emplace_back(0.0F, -20.0F, 500.0F);  // missing in the view
  candidate.points_mm.emplace_back(0.0F, 20.0F, -500.0F);  // behind the camera
  candidate.points_mm.emplace_back(0.0F, 900.0F, 500.0F);  // outside of the image
  compare_with(depth, Eigen::Isometry3d::Identity(), comparison, candidate);
  EXPECT_EQ(candidate.agree, 1);
  EXPECT_EQ(candidate.violations, 1);
  EXPECT_EQ(candidate.unseen, 1);
  EXPECT_EQ(candidate.score(), -1);
}

TEST(CompareWith, LooksAtEveryPixelOfTheImage) {
  const Ball ball;
  const FringeComparison comparison{{kBallPattern, ball.rig, ball.rays}, 0.1};
  const Image<float> depth(160, 160, 500.0F);
  FringeOrderCandidate candidate{.spacing_mm = 10.0};
  for (const double column : {-1.0, 0.0, 159.0, 160.0}) {
    for (const double row : {-1.0, 0.0, 159.0, 160.0}) {
      const Eigen::Vector2d ray = ball.rig.reference().model.ray({column, row});
      candidate.points_mm.emplace_back((500.0 * ray.homogeneous()).cast<float>());
    }
  }
  compare_with(depth, Eigen::Isometry3d::Identity(), comparison, candidate);
  EXPECT_EQ(candidate.agree, 4);  // the corners
  EXPECT_EQ(candidate.unseen + candidate.violations, 0);
}

}  // namespace
}  // namespace frangia
