#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/geometry/clean_mesh.h"
#include "frangia/geometry/connectivity.h"
#include "frangia/geometry/mesh.h"

#include "support/processor_time.h"
#include "support/test_meshes.h"

namespace frangia {
namespace {

/// An open fan: `count` triangles around vertex 0.
Mesh fan(std::uint32_t count) {
  Mesh mesh;
  mesh.vertices_mm.emplace_back(0.0F, 0.0F, 1.0F);
  for (std::uint32_t i = 0; i <= count; ++i) {
    const double angle = 6.0 * i / count;
    mesh.vertices_mm.emplace_back(
        static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), 0.0F);
    if (i < count) mesh.triangles.push_back({0, i + 1, i + 2});
  }
  return mesh;
}

/// A strip of `count` triangles, in which no vertex is in more than three.
Mesh strip(std::uint32_t count) {
  Mesh mesh;
  for (std::uint32_t i = 0; i < count + 2; ++i)
    mesh.vertices_mm.emplace_back(static_cast<float>(i), i % 2 == 0 ? 0.0F : 1.0F, 0.0F);
  for (std::uint32_t i = 0; i < count; ++i) {
    mesh.triangles.push_back(i % 2 == 0 ? Mesh::Triangle{i, i + 2, i + 1}
                                        : Mesh::Triangle{i, i + 1, i + 2});
  }
  return mesh;
}

template <typename Work>
double least_seconds(const Work& work) {
  double least = 1e9;
  for (int i = 0; i < 3; ++i) {
    least = std::min(least, testing::processor_seconds_of(work));
  }
  return least;
}

constexpr std::uint32_t kMany = 40'000;

TEST(HalfEdges, TakeAFanOfManyTrianglesAboutAsLongAsAStrip) {
  const Mesh around = fan(kMany);
  const Mesh along = strip(kMany);
  const double fan_s = least_seconds([&] { static_cast<void>(HalfEdges(around)); });
  const double strip_s = least_seconds([&] { static_cast<void>(HalfEdges(along)); });
  EXPECT_LT(fan_s, 20.0 * strip_s) << fan_s << " s, " << strip_s << " s";  // quadratic: 300 times
}

TEST(HalfEdges, OfAFanHaveTwinsAtItsSpokesAndABoundaryAroundIt) {
  const Mesh mesh = fan(kMany);
  const HalfEdges edges(mesh);
  EXPECT_EQ(edges.outgoing(0).size(), kMany);
  std::size_t boundary = 0;
  for (std::uint32_t e = 0; e < edges.count(); ++e) {
    if (edges.is_boundary(e)) {
      ++boundary;
      continue;
    }
    ASSERT_TRUE(edges.has_twin(e));
    ASSERT_EQ(source_vertex(mesh, edges.twin(e)), target_vertex(mesh, e));
    ASSERT_EQ(target_vertex(mesh, edges.twin(e)), source_vertex(mesh, e));
  }
  EXPECT_EQ(boundary, kMany + 2);
}

TEST(HalfEdges, HaveNoTwinWhereThreeTrianglesShareAnEdge) {
  for (const std::uint32_t others : {0U, 100U}) {  // of low and of high valence
    Mesh mesh = fan(others + 3);
    mesh.vertices_mm.emplace_back(0.0F, 0.0F, 2.0F);
    mesh.triangles.push_back({0, 2, others + 5});  // at the spoke from 0 to 2
    const HalfEdges edges(mesh);
    EXPECT_FALSE(edges.has_twin(2));  // of the first triangle, from 2 to 0
    EXPECT_FALSE(edges.is_boundary(2));
    EXPECT_FALSE(edges.has_twin(3));  // of the second triangle, from 0 to 2
    EXPECT_FALSE(edges.is_boundary(3));
    EXPECT_TRUE(edges.has_twin(5));
  }
}

TEST(HalfEdges, RefuseATriangleOfAVertexThatDoesNotExist) {
  Mesh mesh = fan(3);
  mesh.triangles.push_back({0, 1, 99});
  EXPECT_THROW(HalfEdges{mesh}, Error);
}

TEST(CleanMesh, TakesAFanOfManyTrianglesAboutAsLongAsAStrip) {
  Mesh around = fan(kMany);
  Mesh along = strip(kMany);
  const double fan_s = least_seconds([&] { clean_mesh(around, 1); });
  const double strip_s = least_seconds([&] { clean_mesh(along, 1); });
  EXPECT_LT(fan_s, 20.0 * strip_s) << fan_s << " s, " << strip_s << " s";
  EXPECT_EQ(around.vertices_mm.size(), kMany + 2);
}

}  // namespace
}  // namespace frangia
