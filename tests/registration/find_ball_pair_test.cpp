#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/random.h"
#include "frangia/registration/internal/known_length.h"

namespace frangia {
namespace {

using Eigen::Vector3d;

/// Points spread evenly over the upper three quarters of a ball.
void add_ball(std::vector<OrientedPoint>& points,
              const Vector3d& center,
              double radius,
              int count) {
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - 1.5 * (i + 0.5) / count;
    const double around = 2.399963 * i;
    const Vector3d out(
        std::sqrt(1.0 - z * z) * std::cos(around), std::sqrt(1.0 - z * z) * std::sin(around), z);
    const double noise = 0.001 * radius * normal_from(hash(static_cast<std::uint64_t>(i), 5));
    points.push_back({center + (radius + noise) * out, out});
  }
}

/// A plate of 200 by 100 mm below the balls.
void add_plate(std::vector<OrientedPoint>& points, int count) {
  for (int i = 0; i < count; ++i) {
    const auto n = static_cast<std::uint64_t>(i);
    points.push_back(
        {{200.0 * uniform_from(hash(1, n)) - 100.0, 100.0 * uniform_from(hash(2, n)) - 50.0, -20.0},
         Vector3d::UnitZ()});
  }
}

std::vector<OrientedPoint> bar(double second_radius, int ball_points, int plate_points) {
  std::vector<OrientedPoint> points;
  add_ball(points, {-40.0, 0.0, 0.0}, 12.0, ball_points);
  add_ball(points, {40.0, 5.0, 3.0}, second_radius, ball_points);
  add_plate(points, plate_points);
  return points;
}

TEST(FindBallPair, FindsBothBallsAboveAPlate) {
  const auto points = bar(12.0, 400, 1500);
  const auto found = find_ball_pair(points);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->distance_mm(), Vector3d(80.0, 5.0, 3.0).norm(), 0.01);
  for (const BarBall* ball : {&found->first, &found->second}) {
    EXPECT_NEAR(ball->sphere.radius_mm, 12.0, 0.01);
    const bool left = ball->sphere.center_mm.x() < 0.0;
    EXPECT_LT(
        (ball->sphere.center_mm - (left ? Vector3d(-40.0, 0.0, 0.0) : Vector3d(40.0, 5.0, 3.0)))
            .norm(),
        0.01);
    EXPECT_GT(ball->points.size(), 380U);
    for (const std::size_t i : ball->points)
      EXPECT_TRUE(left ? i < 400 : i >= 400 && i < 800) << i;
  }
}

TEST(FindBallPair, NeedsBallsOfOneDiameter) {
  EXPECT_TRUE(find_ball_pair(bar(12.0 * 1.08, 400, 1000)));
  EXPECT_FALSE(find_ball_pair(bar(12.0 * 1.12, 400, 1000)));
}

TEST(FindBallPair, NeedsATwentiethOfThePointsOnEachBall) {
  EXPECT_TRUE(find_ball_pair(bar(12.0, 200, 3000)));   // 5.9 %
  EXPECT_FALSE(find_ball_pair(bar(12.0, 200, 4400)));  // 4.2 %
}

TEST(FindBallPair, FindsNoneInOneBallAPlateOrFewPoints) {
  std::vector<OrientedPoint> one;
  add_ball(one, {0.0, 0.0, 0.0}, 12.0, 400);
  add_plate(one, 600);
  EXPECT_FALSE(find_ball_pair(one));
  std::vector<OrientedPoint> plate;
  add_plate(plate, 500);
  EXPECT_FALSE(find_ball_pair(plate));
  EXPECT_FALSE(find_ball_pair({}));
  EXPECT_FALSE(find_ball_pair(std::span(one).first(1)));
}

}  // namespace
}  // namespace frangia
