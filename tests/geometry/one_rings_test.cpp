#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "frangia/geometry/connectivity.h"

#include "support/test_meshes.h"

namespace frangia {
namespace {

using Numbers = std::vector<std::uint32_t>;

/// Found by a search through all triangles.
Numbers ring_by_search(const Mesh& mesh, std::uint32_t vertex) {
  Numbers ring;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& corners = mesh.triangles[t];
    if (corners[0] != corners[1] && std::count(corners.begin(), corners.end(), vertex) > 0)
      ring.push_back(t);
  }
  return ring;
}

Numbers numbers(std::span<const std::uint32_t> values) {
  return {values.begin(), values.end()};
}

TEST(OneRings, AreThoseOfASearchForAllVerticesAndForSome) {
  Mesh mesh = testing::sphere({0, 0, 0}, 10.0, 20);
  mesh.triangles[7] = {};  // removed
  const OneRings all(mesh);
  const Numbers some_vertices{5, 300, 0, 5};
  const OneRings some(mesh, some_vertices);
  for (std::uint32_t v = 0; v < mesh.vertices_mm.size(); ++v)
    ASSERT_EQ(numbers(all.of(v)), ring_by_search(mesh, v)) << v;
  std::set<std::uint32_t> around;
  for (const std::uint32_t v : some_vertices) {
    EXPECT_EQ(numbers(some.of(v)), ring_by_search(mesh, v)) << v;
    around.insert(some.of(v).begin(), some.of(v).end());
  }
  EXPECT_EQ(some.selected_triangles(), Numbers(around.begin(), around.end()));
}

TEST(OneRings, NameANeighborTwiceAcrossAnInnerEdgeAndOnceAcrossTheBoundary) {
  Mesh mesh;
  mesh.vertices_mm = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  EXPECT_EQ(one_ring_neighbors(mesh, OneRings(mesh), 0), (Numbers{1, 2, 2, 3}));
}

TEST(VerticesWithin, StopAtTheRingAndAtTheDistance) {
  Mesh mesh;  // a strip along x
  for (std::uint32_t i = 0; i < 20; ++i)
    mesh.vertices_mm.emplace_back(static_cast<float>(i / 2), static_cast<float>(i % 2), 0.0F);
  for (std::uint32_t i = 0; i + 3 < 20; i += 2) {
    mesh.triangles.push_back({i, i + 2, i + 1});
    mesh.triangles.push_back({i + 1, i + 2, i + 3});
  }
  const OneRings rings(mesh);
  Numbers near = vertices_within(mesh, rings, 0, 2, 100.0F);
  std::sort(near.begin(), near.end());
  EXPECT_EQ(near, (Numbers{0, 1, 2, 3, 4}));  // 5 is a third edge away
  near = vertices_within(mesh, rings, 0, 100, 3.1F);
  std::sort(near.begin(), near.end());
  EXPECT_EQ(near, (Numbers{0, 1, 2, 3, 4, 5, 6}));  // 7 is sqrt(10) away
}

}  // namespace
}  // namespace frangia
