#include "frangia/fusion/internal/remove_foldovers.h"

#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "support/test_meshes.h"

namespace frangia {
namespace {

constexpr std::uint32_t kSide = 5;

/// A level grid of vertices one apart, with normals.
Mesh level_grid() {
  Mesh mesh = testing::level_grid(kSide, kSide);
  mesh.normals.assign(mesh.vertices_mm.size(), Eigen::Vector3f::UnitZ());
  return mesh;
}

int folded(const Mesh& mesh) {
  int count = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3f cross = (mesh.vertices_mm[b] - mesh.vertices_mm[a])
                                      .cross(mesh.vertices_mm[c] - mesh.vertices_mm[a]);
    count += cross.z() < 0.0F ? 1 : 0;
  }
  return count;
}

TEST(RemoveFoldovers, RelaxesAVertexBeyondItsNeighbors) {
  Mesh mesh = level_grid();
  mesh.vertices_mm[12] = {3.3F, 2.2F, 0.1F};
  ASSERT_GT(folded(mesh), 0);
  remove_foldovers(mesh, {});
  EXPECT_EQ(folded(mesh), 0);
  EXPECT_EQ(mesh.triangles.size(), level_grid().triangles.size());
  EXPECT_EQ(mesh.vertices_mm[12].z(), 0.1F);  // it moves along the surface only
}

TEST(RemoveFoldovers, RemovesFoldoversAtTheBoundary) {
  Mesh mesh = level_grid();
  mesh.vertices_mm[2] = {2.0F, 1.5F, 0.0F};
  ASSERT_GT(folded(mesh), 0);
  remove_foldovers(mesh, {});
  EXPECT_EQ(folded(mesh), 0);
  EXPECT_LT(mesh.triangles.size(), level_grid().triangles.size());
}

TEST(RemoveFoldovers, NeverLeavesAFoldoverWhereNothingMayMove) {
  Mesh mesh = level_grid();
  mesh.vertices_mm[12] = {3.3F, 2.2F, 0.0F};
  const std::vector<std::uint8_t> sharp(mesh.vertices_mm.size(), 1);
  remove_foldovers(mesh, sharp);
  EXPECT_EQ(folded(mesh), 0);
  EXPECT_EQ(mesh.vertices_mm[12].x(), 3.3F);
}

TEST(RemoveFoldovers, LeavesAValidMeshUnchanged) {
  Mesh mesh = level_grid();
  remove_foldovers(mesh, {});
  EXPECT_EQ(mesh.triangles, level_grid().triangles);
  EXPECT_EQ(mesh.vertices_mm, level_grid().vertices_mm);
}

}  // namespace
}  // namespace frangia
