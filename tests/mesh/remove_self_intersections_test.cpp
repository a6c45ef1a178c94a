#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include <gtest/gtest.h>

#include "frangia/geometry/boundary.h"
#include "frangia/geometry/components.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/mesh/make_manifold.h"
#include "frangia/mesh/self_intersections.h"

#include "support/test_meshes.h"

namespace frangia {
namespace {

using testing::open_edges;
using testing::sphere;
using testing::volume_mm3;

using Position = std::tuple<float, float, float>;

std::set<Position> positions_of(const Mesh& mesh) {
  std::set<Position> all;
  for (const auto& p : mesh.vertices_mm)
    all.emplace(p.x(), p.y(), p.z());
  return all;
}

/// A square sheet of `count` vertices per side, 1 mm apart, centred on the origin, facing z.
Mesh sheet(int count) {
  Mesh mesh;
  for (int x = 0; x < count; ++x) {
    for (int y = 0; y < count; ++y) {
      const auto half = 0.5F * static_cast<float>(count - 1);
      mesh.vertices_mm.emplace_back(static_cast<float>(x) - half, static_cast<float>(y) - half, 0);
    }
  }
  const auto at = [&](int x, int y) { return static_cast<std::uint32_t>(x * count + y); };
  for (int x = 0; x + 1 < count; ++x) {
    for (int y = 0; y + 1 < count; ++y) {
      mesh.triangles.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1)});
      mesh.triangles.push_back({at(x, y), at(x + 1, y + 1), at(x, y + 1)});
    }
  }
  return mesh;
}

TEST(RemoveSelfIntersections, ClosesABallDentedThroughItsOtherSide) {
  Mesh mesh = sphere(Eigen::Vector3d::Zero(), 20.0, 40);
  for (auto& vertex : mesh.vertices_mm) {
    if (vertex.x() > 19.0F) vertex.x() -= 42.0F;
  }
  ASSERT_FALSE(self_intersections(mesh).empty());
  const Mesh repaired = remove_self_intersections(mesh);
  EXPECT_TRUE(self_intersections(repaired).empty());
  EXPECT_EQ(open_edges(repaired), 0U);
  EXPECT_EQ(connected_components(repaired).components.size(), 1U);
}

TEST(RemoveSelfIntersections, UnitesTwoIntersectingBalls) {
  Mesh mesh = sphere({0, 0, 0}, 10.0, 60);
  append_mesh(mesh, sphere({12.0, 0.3, 0.2}, 10.0, 60));
  const Mesh united = remove_self_intersections(mesh);
  EXPECT_TRUE(self_intersections(united).empty());
  EXPECT_EQ(open_edges(united), 0U);
  EXPECT_EQ(connected_components(united).components.size(), 1U);
  // The volume of two balls minus their common lens.
  const double h = 10.0 - 0.5 * std::hypot(12.0, 0.3, 0.2);
  const double lens = 2.0 * kPi * h * h * (30.0 - h) / 3.0;
  EXPECT_NEAR(volume_mm3(united) / (8000.0 * kPi / 3.0 - lens), 1.0, 0.003);
  const auto after = positions_of(united);
  for (const auto& [x, y, z] : positions_of(mesh)) {
    EXPECT_TRUE((x > 4.0F && x < 8.0F) || after.contains({x, y, z}) ||
                (x >= 8.0F ? std::hypot(x, y, z) : std::hypot(x - 12, y, z)) < 10.5F);
  }
}

TEST(RemoveSelfIntersections, KeepsTheRestOfTwoSheetsAroundASpike) {
  Mesh mesh = sheet(41);
  for (auto& vertex : mesh.vertices_mm)
    vertex.z() = 25.0F * std::exp(-vertex.head<2>().squaredNorm() / 4.0F);
  Mesh other = sheet(41);
  for (auto& vertex : other.vertices_mm)
    vertex += Eigen::Vector3f(0.13F, 0.07F, 10.0F);
  append_mesh(mesh, other);
  ASSERT_FALSE(self_intersections(mesh).empty());
  const Mesh repaired = remove_self_intersections(mesh);
  EXPECT_TRUE(self_intersections(repaired).empty());
  EXPECT_EQ(count_non_manifold_edges(repaired), 0U);
  EXPECT_EQ(boundary_loops(repaired).size(), 2U);  // of the two sheets
  const auto after = positions_of(repaired);
  for (const auto& [x, y, z] : positions_of(mesh))
    EXPECT_TRUE(std::hypot(x, y) < 5.0F || after.contains({x, y, z}));
}

TEST(RemoveSelfIntersections, KeepsTheBoundariesOfOpenSheetsOpen) {
  Mesh mesh = sheet(21);
  Mesh upright = sheet(21);
  for (auto& vertex : upright.vertices_mm)
    vertex = Eigen::Vector3f(vertex.x() + 0.3F, 0.2F, vertex.y() + 0.4F);
  append_mesh(mesh, upright);
  const Mesh repaired = remove_self_intersections(mesh);
  EXPECT_TRUE(self_intersections(repaired).empty());
  EXPECT_TRUE(std::none_of(repaired.triangle_marks.begin(),
                           repaired.triangle_marks.end(),
                           [](Mark mark) { return mark == Mark::Synthesized; }));
  EXPECT_GT(boundary_loops(repaired).size(), 2U);
}

TEST(RemoveSelfIntersections, KeepsAMeshWithoutSelfIntersections) {
  const Mesh mesh = sphere({0, 0, 0}, 10.0, 20);
  EXPECT_EQ(remove_self_intersections(mesh).triangles, mesh.triangles);
}

}  // namespace
}  // namespace frangia
