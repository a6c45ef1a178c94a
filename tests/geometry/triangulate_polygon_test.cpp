#include "frangia/geometry/triangulate_polygon.h"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"

namespace frangia {
namespace {

Polygon round(const Eigen::Vector2d& center, double radius, int count) {
  Polygon polygon;
  for (int i = 0; i < std::abs(count); ++i) {
    const double angle = kTwoPi * i / count;  // a negative count runs clockwise
    polygon.emplace_back(center + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  return polygon;
}

double area(const Polygon& polygon) {
  double sum = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const auto& a = polygon[i];
    const auto& b = polygon[(i + 1) % polygon.size()];
    sum += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  return sum;
}

/// Checks the triangles of a polygon: each turns left, their areas add up, and all points are used.
void expect_fills(const Polygon& outer, const std::vector<Polygon>& holes = {}) {
  Polygon points = outer;
  double expected = area(outer);
  for (const Polygon& hole : holes) {
    points.insert(points.end(), hole.begin(), hole.end());
    expected += area(hole);
  }
  const auto triangles = triangulate_polygon(outer, holes);
  EXPECT_EQ(triangles.size(), points.size() + 2 * holes.size() - 2);
  double sum = 0.0;
  std::set<std::size_t> used;
  for (const auto& [a, b, c] : triangles) {
    const double own = area({points[a], points[b], points[c]});
    EXPECT_GE(own, -1e-12 * std::abs(expected));
    sum += own;
    used.insert({a, b, c});
  }
  EXPECT_NEAR(sum, expected, 1e-9 * std::abs(expected));
  EXPECT_EQ(used.size(), points.size());
}

TEST(TriangulatePolygon, FillsConvexAndConcavePolygons) {
  expect_fills(round({3, 4}, 10.0, 200));
  expect_fills({{0, 0}, {10, 0}, {10, 10}, {8, 10}, {8, 2}, {2, 2}, {2, 10}, {0, 10}});
}

TEST(TriangulatePolygon, KeepsCollinearPoints) {
  expect_fills({{0, 0}, {3, 0}, {5, 0}, {10, 0}, {10, 10}, {4, 10}, {0, 10}, {0, 5}});
}

TEST(TriangulatePolygon, LeavesHolesOpen) {
  const Polygon square{{-20, -20}, {20, -20}, {20, 20}, {-20, 20}};
  expect_fills(square, {round({0, 0}, 5.0, -64)});
  expect_fills(square,
               {round({-10, -10}, 4.0, -32),
                round({10, -10}, 4.0, -32),
                round({-10, 10}, 4.0, -32),
                round({10, 10}, 4.0, -32),
                round({0, 0}, 6.0, -100)});
}

TEST(TriangulatePolygon, RefusesInvalidPolygons) {
  const Polygon bow{{0, 0}, {10, 10}, {10, 0}, {0, 10}};
  const Polygon clockwise{{0, 0}, {0, 10}, {10, 10}, {10, 0}};
  const Polygon square{{0, 0}, {10, 0}, {10, 10}, {0, 10}};
  EXPECT_THROW(static_cast<void>(triangulate_polygon(bow)), Error);
  EXPECT_THROW(static_cast<void>(triangulate_polygon(clockwise)), Error);
  EXPECT_THROW(static_cast<void>(triangulate_polygon({{0, 0}, {1, 1}})), Error);
  EXPECT_THROW(static_cast<void>(triangulate_polygon(square, {round({30, 5}, 2.0, -16)})), Error);
}

TEST(TriangulatePolygon, WorksAtAnyScale) {
  for (const double scale : {1e-6, 1e6}) {
    expect_fills(round({0, 0}, 10.0 * scale, 200), {round({0, 0}, 5.0 * scale, -64)});
    expect_fills({{0, 0}, {3 * scale, 0}, {9 * scale, 0}, {9 * scale, 7 * scale}, {0, 7 * scale}});
  }
}

}  // namespace
}  // namespace frangia
