// Edge collapses keep a mesh manifold: the link condition on meshes small enough to enumerate.
#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/random.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/mesh/decimate.h"
#include "frangia/mesh/internal/edge_collapse.h"
#include "frangia/mesh/make_manifold.h"

#include "support/test_meshes.h"

namespace frangia {
namespace {

Mesh mesh_of(std::size_t vertices, std::vector<Mesh::Triangle> triangles) {
  Mesh mesh;
  for (std::size_t i = 0; i < vertices; ++i)
    mesh.vertices_mm.emplace_back(static_cast<float>(i), static_cast<float>(i * i), 0.0F);
  mesh.triangles = std::move(triangles);
  return mesh;
}

bool can_collapse(Mesh mesh, std::uint32_t a, std::uint32_t b) {
  const HalfEdges edges(mesh);
  return CollapseTopology(mesh, edges).can_collapse(a, b);
}

/// Two apexes, 0 and 1, over a triangle of the vertices 2, 3 and 4.
Mesh bipyramid() {
  return mesh_of(5, {{0, 2, 3}, {0, 3, 4}, {0, 4, 2}, {1, 3, 2}, {1, 4, 3}, {1, 2, 4}});
}

TEST(CollapseTopology, RefusesEveryEdgeOfATetrahedron) {
  const Mesh tetrahedron = mesh_of(4, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
  for (std::uint32_t a = 0; a < 4; ++a) {
    for (std::uint32_t b = 0; b < a; ++b)
      EXPECT_FALSE(can_collapse(tetrahedron, a, b)) << a << ' ' << b;
  }
}

TEST(CollapseTopology, RefusesAnEdgeWhoseEndsHaveANeighborInCommonBesideItsTriangles) {
  // The base of the bipyramid is a cycle of three edges, but not a triangle.
  for (const auto& [a, b] : {std::pair{2U, 3U}, {3U, 4U}, {4U, 2U}})
    EXPECT_FALSE(can_collapse(bipyramid(), a, b));
  for (std::uint32_t base = 2; base < 5; ++base) {
    EXPECT_TRUE(can_collapse(bipyramid(), 0, base));
    EXPECT_TRUE(can_collapse(bipyramid(), base, 1));
  }
  EXPECT_FALSE(can_collapse(bipyramid(), 0, 1));  // no edge
}

TEST(CollapseTopology, RefusesToPinchASheetAtAnInnerEdgeBetweenBoundaryVertices) {
  const Mesh square = mesh_of(4, {{0, 1, 2}, {0, 2, 3}});
  EXPECT_FALSE(can_collapse(square, 0, 2));  // the diagonal
  EXPECT_TRUE(can_collapse(square, 0, 1));   // a side
  EXPECT_FALSE(can_collapse(mesh_of(3, {{0, 1, 2}}), 0, 1));
}

TEST(CollapseTopology, FixesTheEndsOfANonManifoldEdge) {
  Mesh book = mesh_of(5, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}});
  const HalfEdges edges(book);
  const CollapseTopology topology(book, edges);
  EXPECT_TRUE(topology.is_fixed(0));
  EXPECT_TRUE(topology.is_fixed(1));
  EXPECT_FALSE(topology.is_fixed(2));
}

TEST(CollapseTopology, KeepsASphereUntilNoEdgeIsLeftToCollapse) {
  Mesh mesh = testing::sphere(Eigen::Vector3d::Zero(), 10.0, 8);
  const HalfEdges edges(mesh);
  CollapseTopology topology(mesh, edges);
  std::vector<std::uint32_t> neighbors;
  for (std::uint64_t i = 0; i < 20'000; ++i) {
    const auto a = static_cast<std::uint32_t>(hash(1, i) % mesh.vertices_mm.size());
    if (topology.is_removed(a)) continue;
    topology.neighbors(a, neighbors);
    const std::uint32_t b = neighbors.at(hash(2, i) % neighbors.size());
    if (topology.can_collapse(a, b)) topology.collapse(a, b);
  }
  EXPECT_EQ(topology.remaining_triangles(), 4U);
  keep_triangles(mesh, topology.alive());
  EXPECT_EQ(mesh.vertices_mm.size(), 4U);
  EXPECT_EQ(testing::open_edges(mesh), 0U);
  EXPECT_EQ(count_non_manifold_edges(mesh), 0U);
}

/// A flat L of squares of 1 mm whose inner vertices are jittered in the plane, facing z.
Mesh jittered_l_shape(int side) {
  Mesh mesh;
  std::vector<std::uint32_t> number(static_cast<std::size_t>((side + 1) * (side + 1)));
  const auto is_inside = [&](int x, int y) { return x < side / 2 || y < side / 2; };
  for (int x = 0; x <= side; ++x) {
    for (int y = 0; y <= side; ++y) {
      const auto id = static_cast<std::uint32_t>(mesh.vertices_mm.size());
      number[static_cast<std::size_t>(x * (side + 1) + y)] = id;
      const bool inner = x > 0 && y > 0 && x < side && y < side && is_inside(x, y);
      const double jitter = inner ? 0.35 : 0.0;
      mesh.vertices_mm.emplace_back(
          static_cast<float>(x + jitter * (2.0 * uniform_from(hash(3, id)) - 1.0)),
          static_cast<float>(y + jitter * (2.0 * uniform_from(hash(4, id)) - 1.0)),
          0.0F);
    }
  }
  const auto at = [&](int x, int y) {
    return number[static_cast<std::size_t>(x * (side + 1) + y)];
  };
  for (int x = 0; x < side; ++x) {
    for (int y = 0; y < side; ++y) {
      if (!is_inside(x, y)) continue;
      mesh.triangles.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1)});
      mesh.triangles.push_back({at(x, y), at(x + 1, y + 1), at(x, y + 1)});
    }
  }
  return mesh;
}

TEST(Decimate, FlipsNoTriangleOfAConcaveSheet) {
  const Mesh few = decimate(jittered_l_shape(20), {.triangles = 12});
  EXPECT_LE(few.triangles.size(), 12U);
  double area_mm2 = 0.0;
  for (const auto& [a, b, c] : few.triangles) {
    const Eigen::Vector3f cross =
        (few.vertices_mm[b] - few.vertices_mm[a]).cross(few.vertices_mm[c] - few.vertices_mm[a]);
    EXPECT_GT(cross.z(), 0.0F);
    area_mm2 += 0.5 * static_cast<double>(cross.z());
  }
  EXPECT_NEAR(area_mm2, 300.0, 1.0);
}

}  // namespace
}  // namespace frangia
