#include <algorithm>
#include <cmath>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/simulate/internal/solid_builder.h"
#include "frangia/simulate/parts.h"

namespace frangia {

Mesh make_groove() {
  constexpr double kHeight = 50.0;
  const auto outline = [](double z) {
    return Loop{{-20.0, -32.0, z},
                {15.0, -32.0, z},
                {15.0, -25.0, z},
                {-10.0, 0.0, z},
                {15.0, 25.0, z},
                {15.0, 32.0, z},
                {-20.0, 32.0, z}};
  };
  const Loop low = outline(0.0);
  const Loop high = outline(kHeight);
  SolidBuilder solid;
  solid.add_face(high);
  solid.add_band(low, high);
  solid.add_face(reversed(low));
  return solid.build();
}

Mesh make_plate() {
  const auto outline = [](double x) {
    return Loop{{x, -40.0, 0.0}, {x, 40.0, 0.0}, {x, 40.0, 60.0}, {x, -40.0, 60.0}};
  };
  const Loop front = outline(3.0);
  const Loop back = outline(-3.0);
  SolidBuilder solid;
  solid.add_face(front);
  solid.add_band(back, front);
  solid.add_face({back.rbegin(), back.rend()});
  return solid.build();
}

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

namespace {

constexpr int kAroundDumbbell = 400;  ///< points around: 0.0006 mm of chord error on 40 mm
constexpr int kDumbbellRings = 180;   ///< from pole to pole of a ball
constexpr double kRodShare = 0.25;    ///< radius of the rod, of the smaller ball's

/// A point of the profile that turns about z.
struct ProfilePoint {
  double z;
  double radius;
};

/// Adds the points of a ball from one polar angle, from below, to another.
void add_arc(std::vector<ProfilePoint>& profile, double z, double radius, double from, double to) {
  for (int i = 0; i <= kDumbbellRings; ++i) {
    const double polar = from + (to - from) * i / kDumbbellRings;
    profile.push_back({z - radius * std::cos(polar), radius * std::sin(polar)});
  }
}

/// Turns a profile whose first and last points lie on the axis.
Mesh turned(const std::vector<ProfilePoint>& profile) {
  SolidBuilder solid;
  const auto ring = [&](std::size_t i) {
    return circle({0.0, 0.0, profile[i].z}, profile[i].radius, kAroundDumbbell);
  };
  Loop below = ring(1);
  solid.add_fan({below.rbegin(), below.rend()}, {0.0, 0.0, profile.front().z});
  for (std::size_t i = 2; i + 1 < profile.size(); ++i) {
    const Loop above = ring(i);
    solid.add_band(below, above);
    below = above;
  }
  solid.add_fan(below, {0.0, 0.0, profile.back().z});
  return solid.build();
}

}  // namespace

Mesh make_dumbbell(const std::vector<double>& diameters_mm, double spacing_mm) {
  if (diameters_mm.empty() || diameters_mm.size() > 2)
    throw Error(ErrorKind::Input, "a dumbbell has one ball or two");
  const double rod = kRodShare * 0.5 * *std::min_element(diameters_mm.begin(), diameters_mm.end());
  std::vector<ProfilePoint> profile;
  const double upper = 0.5 * diameters_mm.back();
  const double upper_z = 0.5 * spacing_mm;
  if (diameters_mm.size() == 2) {
    const double lower = 0.5 * diameters_mm.front();
    add_arc(profile, -0.5 * spacing_mm, lower, 0.0, kPi - std::asin(rod / lower));
  } else {
    const double foot_z = upper_z - 2.5 * upper;
    profile = {{foot_z, 0.0}, {foot_z, rod}};
  }
  add_arc(profile, upper_z, upper, std::asin(rod / upper), kPi);
  return turned(profile);
}

}  // namespace frangia
