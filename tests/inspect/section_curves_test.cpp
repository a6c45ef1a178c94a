// Sections of meshes by planes, and profiles of blades.
#include "frangia/inspect/section_curves.h"

#include <cmath>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/inspect/blade_section.h"

#include "support/test_meshes.h"

namespace frangia {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Positive for a counter-clockwise curve.
double area_of(const SectionCurve& curve) {
  double area = 0.0;
  for (std::size_t i = 0; i < curve.points_mm.size(); ++i) {
    const Vector2d& a = curve.points_mm[i];
    const Vector2d& b = curve.points_mm[(i + 1) % curve.points_mm.size()];
    area += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  return area;
}

TEST(SectionCurves, TheAreaIsThatOfTheMaterialAndNoneWhereACurveIsOpen) {
  Mesh shell = testing::sphere({1, 2, 3}, 20.0);
  Mesh inside = testing::sphere({1, 2, 3}, 15.0);
  for (Mesh::Triangle& triangle : inside.triangles)
    std::swap(triangle[0], triangle[1]);
  append_mesh(shell, inside);
  const SectionPlane middle = section_plane({1, 2, 3}, Vector3d::UnitY());
  EXPECT_NEAR(area_mm2(section_curves(shell, middle)), kPi * (400.0 - 225.0), 2.0);
  EXPECT_EQ(area_mm2({}), 0.0);
  shell.triangles.resize(shell.triangles.size() / 4);  // half of the outer sphere is left
  EXPECT_TRUE(std::isnan(area_mm2(section_curves(shell, middle))));
}

/// Against the truth of a viewer who stands on the ground and looks against the normal.
TEST(SectionCurves, StandAsThePartDoesSeenAgainstTheNormal) {
  for (const Vector3d& normal : {Vector3d(0, 1, 0),
                                 Vector3d(0, -1, 0),
                                 Vector3d(1, 0, 0),
                                 Vector3d(-1, 0, 0),
                                 Vector3d(1, 2, 0),
                                 Vector3d(-3, 1, 1)}) {
    const SectionPlane plane = section_plane({1, 2, 3}, normal);
    EXPECT_GT(plane.v.z(), 0.9) << normal.transpose();  // up
    EXPECT_NEAR(plane.u.z(), 0.0, 1e-12) << normal.transpose();
    EXPECT_LT((plane.u.cross(plane.v) - plane.normal).norm(), 1e-12) << normal.transpose();
  }
  for (const double up : {1.0, -1.0}) {
    const SectionPlane plane = section_plane({1, 2, 3}, {0.1, 0.1, up});
    EXPECT_GT(plane.u.x(), 0.9);
    EXPECT_LT((plane.u.cross(plane.v) - plane.normal).norm(), 1e-12);
  }
}

TEST(SectionCurves, OfASphereIsACircleWithTheMaterialAtItsLeft) {
  const Mesh mesh = testing::sphere({1, 2, 3}, 20.0);
  std::vector<float> heights;
  for (const auto& vertex : mesh.vertices_mm)
    heights.push_back(vertex.z());
  const SectionPlane plane = section_plane({1, 2, 15}, Vector3d::UnitZ());
  const auto curves = section_curves(mesh, plane, heights);
  ASSERT_EQ(curves.size(), 1U);
  EXPECT_TRUE(curves[0].closed);
  const double radius = 16.0;  // 20, 12 above the center
  EXPECT_NEAR(length_mm(curves[0]), kTwoPi * radius, 0.1);
  EXPECT_NEAR(area_of(curves[0]), kPi * radius * radius, 1.0);
  for (const Vector2d& point : curves[0].points_mm)
    EXPECT_NEAR(point.norm(), radius, 0.01);
  for (const double value : curves[0].values)
    EXPECT_NEAR(value, 15.0, 1e-4);
}

TEST(SectionCurves, AreOrientedAlikeForEveryPlaneAndLongestFirst) {
  Mesh mesh = testing::box({0, 0, 0}, {10, 20, 30});
  const Mesh small = testing::sphere({40, 5, 5}, 3.0, 20);
  const auto first = static_cast<std::uint32_t>(mesh.vertices_mm.size());
  mesh.vertices_mm.insert(
      mesh.vertices_mm.end(), small.vertices_mm.begin(), small.vertices_mm.end());
  for (const auto& [a, b, c] : small.triangles)
    mesh.triangles.push_back({a + first, b + first, c + first});
  for (const Vector3d& normal : {Vector3d(0, 0, 1), Vector3d(0, 0, -1), Vector3d(0.05, 1, 0.1)}) {
    const auto curves = section_curves(mesh, section_plane({5, 5, 5.01}, normal));
    ASSERT_EQ(curves.size(), 2U);
    EXPECT_GT(length_mm(curves[0]), length_mm(curves[1]));
    for (const SectionCurve& curve : curves)
      EXPECT_GT(area_of(curve), 0.0);
  }
  EXPECT_TRUE(section_curves(mesh, section_plane({0, 0, 99}, Vector3d::UnitZ())).empty());
}

TEST(SectionCurves, AreOpenWhereTrianglesWereSynthesized) {
  Mesh mesh = testing::sphere({0, 0, 0}, 20.0);
  for (const auto& triangle : mesh.triangles) {
    const bool filled = mesh.vertices_mm[triangle[0]].x() > 15.0F;
    mesh.triangle_marks.push_back(filled ? Mark::Synthesized : Mark::Measured);
  }
  const auto curves = section_curves(mesh, section_plane({0, 0, 0.1}, Vector3d::UnitZ()));
  ASSERT_EQ(curves.size(), 1U);
  EXPECT_FALSE(curves[0].closed);
  for (const Vector2d& point : curves[0].points_mm)
    EXPECT_LT(point.x(), 16.0);
}

/// The hull of a circle of radius 3 at the origin and one of radius 1 at 40 mm, turned.
SectionCurve wedge(double turn_rad) {
  SectionCurve curve;
  curve.closed = true;
  const double slope = std::asin((3.0 - 1.0) / 40.0);  // of the tangents
  const auto add_arc = [&](double x, double radius, double from, double to) {
    constexpr int kSteps = 90;
    for (int i = 0; i < kSteps; ++i) {
      const double angle = from + (to - from) * i / (kSteps - 1.0);
      const Vector2d p(x + radius * std::cos(angle), radius * std::sin(angle));
      const double c = std::cos(turn_rad);
      const double s = std::sin(turn_rad);
      curve.points_mm.emplace_back(c * p.x() - s * p.y(), s * p.x() + c * p.y());
    }
  };
  add_arc(40.0, 1.0, -0.5 * kPi + slope, 0.5 * kPi - slope);
  add_arc(0.0, 3.0, 0.5 * kPi - slope, 1.5 * kPi + slope);
  return curve;
}

TEST(BladeSection, HasTheSizesOfAWedgeOfTwoCircles) {
  for (const double turn : {0.0, 0.5, -1.2, 2.9}) {
    const BladeSection blade = measure_blade_section(wedge(turn));
    EXPECT_NEAR(blade.chord_mm, 44.0, 0.01);
    EXPECT_NEAR(blade.max_thickness_mm, 6.0, 0.02);
    EXPECT_NEAR(blade.leading_radius_mm, 3.0, 0.02);
    EXPECT_NEAR(blade.trailing_radius_mm, 1.0, 0.02);
    const double folded = turn > 0.5 * kPi ? turn - kPi : turn;
    EXPECT_NEAR(blade.stagger_rad, folded, 2e-3);
    EXPECT_NEAR(blade.max_camber_mm, 0.0, 0.05);
    ASSERT_GT(blade.camber_mm.size(), 100U);
    const Vector2d leading(-3.0 * std::cos(turn), -3.0 * std::sin(turn));
    EXPECT_NEAR((blade.leading_mm - leading).norm(), 0.0, 0.2);
  }
}

TEST(BladeSection, RefusesWhatIsNoProfile) {
  SectionCurve open = wedge(0.0);
  open.closed = false;
  EXPECT_THROW(static_cast<void>(measure_blade_section(open)), Error);
  const auto circle =
      section_curves(testing::sphere({0, 0, 0}, 20.0), section_plane({0, 0, 1}, Vector3d::UnitZ()));
  EXPECT_THROW(static_cast<void>(measure_blade_section(circle.front())), Error);
}

}  // namespace
}  // namespace frangia
