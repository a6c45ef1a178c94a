#include <cmath>

#include "frangia/core/angles.h"
#include "frangia/simulate/internal/solid_builder.h"
#include "frangia/simulate/parts.h"

namespace frangia {
namespace {

constexpr double kBallRadius = 20.0;
constexpr double kPostRadius = 7.0;
constexpr double kFootTop = 8.0;
constexpr int kAroundBall = 400;  ///< points around: 0.0006 mm of chord error on the ball
constexpr int kRings = 180;       ///< from the post to the pole

/// The post and the ball on it, above the base; returns the post's foot.
Loop add_post_and_ball(SolidBuilder& solid, const Eigen::Vector3d& center) {
  Loop foot = circle({center.x(), center.y(), kFootTop}, kPostRadius, kAroundBall);
  const double first = std::asin(kPostRadius / kBallRadius);  // polar angle, from below
  const auto ring = [&](int i) {
    const double polar = first + (kPi - first) * i / kRings;
    const double radius = i == 0 ? kPostRadius : kBallRadius * std::sin(polar);
    return circle(
        center - Eigen::Vector3d(0.0, 0.0, kBallRadius * std::cos(polar)), radius, kAroundBall);
  };
  Loop below = foot;
  for (int i = 0; i < kRings; ++i) {
    const Loop above = ring(i);
    solid.add_band(below, above);
    below = above;
  }
  solid.add_fan(below, center + Eigen::Vector3d(0.0, 0.0, kBallRadius));
  return foot;
}

}  // namespace

Mesh make_ball_bar() {
  const auto outline = [](double z) {
    return Loop{{-20.0, -60.0, z}, {20.0, -60.0, z}, {20.0, 60.0, z}, {-20.0, 60.0, z}};
  };
  SolidBuilder solid;
  std::vector<Loop> holes;
  for (const double y : {-35.0, 35.0}) {
    const Loop foot = add_post_and_ball(solid, {0.0, y, 60.0});
    holes.emplace_back(foot.rbegin(), foot.rend());
  }
  const Loop low = outline(0.0);
  const Loop high = outline(kFootTop);
  solid.add_face(high, holes);
  solid.add_band(low, high);
  solid.add_face({low.rbegin(), low.rend()});
  return solid.build();
}

}  // namespace frangia
