#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/mesh/internal/triangulate_hole.h"

namespace frangia {
namespace {

using Eigen::Vector3d;
using Line = std::vector<Vector3d>;

double area_of(const Line& line, const std::vector<std::array<std::size_t, 3>>& triangles) {
  Vector3d sum = Vector3d::Zero();
  double area = 0.0;
  for (const auto& [a, b, c] : triangles) {
    const Vector3d cross = (line[b] - line[a]).cross(line[c] - line[a]);
    sum += cross / 2.0;
    area += cross.norm() / 2.0;
  }
  EXPECT_NEAR(sum.norm(), area, 1e-9 * area);  // no triangle is folded
  return area;
}

/// A star with alternating radii.
Line star(std::size_t corners) {
  Line line;
  for (std::size_t i = 0; i < corners; ++i) {
    const double turn = kTwoPi * static_cast<double>(i) / static_cast<double>(corners);
    const double radius = i % 2 == 0 ? 10.0 : 9.9;
    line.emplace_back(radius * std::cos(turn), radius * std::sin(turn), 0.0);
  }
  return line;
}

double area_of_star(std::size_t corners) {
  return 0.5 * static_cast<double>(corners) * 99.0 *
         std::sin(kTwoPi / static_cast<double>(corners));
}

TEST(MinimumAreaTriangulation, CoversAStarOfFewCornersOnce) {
  const Line line = star(40);
  const auto triangles = minimum_area_triangulation(line);
  EXPECT_EQ(triangles.size(), 38U);
  EXPECT_NEAR(area_of(line, triangles), area_of_star(40), 1e-9);
}

TEST(MinimumAreaTriangulation, CoversAStarOfManyCornersOnce) {
  const Line line = star(3000);
  const auto triangles = minimum_area_triangulation(
      line, {.normals = {line.size(), Vector3d::UnitZ()}, .is_forbidden = {}});
  EXPECT_EQ(triangles.size(), 2998U);
  EXPECT_NEAR(area_of(line, triangles), area_of_star(3000), 1e-6);
}

TEST(MinimumAreaTriangulation, AvoidsAForbiddenChord) {
  const Line square{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 1, 0}};
  for (const std::size_t first : {0U, 1U}) {
    const auto is_forbidden = [first](std::size_t a, std::size_t b) {
      return std::min(a, b) == first && std::max(a, b) == first + 2;
    };
    for (const auto& [a, b, c] :
         minimum_area_triangulation(square, {.normals = {}, .is_forbidden = is_forbidden})) {
      EXPECT_FALSE(is_forbidden(a, b));
      EXPECT_FALSE(is_forbidden(b, c));
      EXPECT_FALSE(is_forbidden(c, a));
    }
  }
}

TEST(MinimumAreaTriangulation, IsEmptyForTwoCorners) {
  EXPECT_TRUE(minimum_area_triangulation({{0, 0, 0}, {1, 0, 0}}).empty());
}

}  // namespace
}  // namespace frangia
