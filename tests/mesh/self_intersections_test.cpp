#include "frangia/mesh/self_intersections.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "frangia/core/error.h"
#include "frangia/geometry/triangles_intersect.h"

#include "support/processor_time.h"

namespace frangia {
namespace {

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// `count` triangles around vertex 0, a cone with its tip at a height of 1.
Mesh closed_fan(std::uint32_t count) {
  Mesh mesh;
  mesh.vertices_mm.emplace_back(0.0F, 0.0F, 1.0F);
  for (std::uint32_t i = 0; i < count; ++i) {
    const double angle = 2.0 * M_PI * i / count;
    mesh.vertices_mm.emplace_back(
        static_cast<float>(50.0 * std::cos(angle)), static_cast<float>(50.0 * std::sin(angle)), 0);
    mesh.triangles.push_back({0, i + 1, (i + 1) % count + 1});
  }
  return mesh;
}

/// Tests every pair of triangles.
Pairs by_all_pairs(const Mesh& mesh) {
  const auto corners = [&](std::uint32_t t) {
    return indexed_triangle(mesh.triangles[t],
                            [&](std::uint32_t v) { return mesh.vertices_mm[v].cast<double>(); });
  };
  Pairs pairs;
  for (std::uint32_t a = 0; a < mesh.triangles.size(); ++a) {
    for (std::uint32_t b = a + 1; b < mesh.triangles.size(); ++b)
      if (triangles_intersect(corners(a), corners(b))) pairs.emplace_back(a, b);
  }
  return pairs;
}

TEST(SelfIntersections, OfAFanOf40000TrianglesTakeSeconds) {
  if (!can_test_intersections()) GTEST_SKIP() << "built without CGAL";
  const Mesh fan = closed_fan(40'000);
  const double seconds =
      testing::processor_seconds_of([&] { EXPECT_TRUE(self_intersections(fan).empty()); });
  EXPECT_LT(seconds, 8.0);  // 33 s of processor where all pairs at the apex are tested
}

TEST(SelfIntersections, OfManyTrianglesThatCoincideAreRefused) {
  if (!can_test_intersections()) GTEST_SKIP() << "built without CGAL";
  Mesh mesh;
  for (std::uint32_t i = 0; i < 10'000; ++i) {
    for (const float x : {0.0F, 1.0F, 2.0F})
      mesh.vertices_mm.emplace_back(x, x * x, 0.0F);
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  EXPECT_THROW(static_cast<void>(self_intersections(mesh)), Error);
}

TEST(SelfIntersections, OfVerticesOfHighValenceAreThoseOfAllPairs) {
  if (!can_test_intersections()) GTEST_SKIP() << "built without CGAL";
  std::mt19937 random(1);
  std::uniform_real_distribution<float> anywhere(-50.0F, 50.0F);
  Mesh mesh = closed_fan(400);
  const auto second = static_cast<std::uint32_t>(mesh.vertices_mm.size());
  mesh.vertices_mm.emplace_back(0.0F, 0.0F, -1.0F);
  for (std::uint32_t i = 0; i < 400; ++i)  // a second fan below, on the same rim
    mesh.triangles.push_back({second, (i + 1) % 400 + 1, i + 1});
  for (std::uint32_t i = 0; i < 100; ++i) {  // fins at the apex, and triangles elsewhere
    const auto first = static_cast<std::uint32_t>(mesh.vertices_mm.size());
    for (int k = 0; k < 3; ++k)
      mesh.vertices_mm.emplace_back(anywhere(random), anywhere(random), 0.02F * anywhere(random));
    mesh.triangles.push_back({i % 2 == 0 ? 0 : first + 2, first, first + 1});
  }
  const Pairs expected = by_all_pairs(mesh);
  EXPECT_GT(expected.size(), 1000U);
  EXPECT_EQ(self_intersections(mesh), expected);
}

}  // namespace
}  // namespace frangia
