#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/fusion/internal/remove_slivers.h"
#include "frangia/geometry/clean_mesh.h"
#include "frangia/geometry/connectivity.h"

#include "support/test_meshes.h"

namespace frangia {
namespace {

/// A box with a second vertex close to one of its corners.
Mesh box_with_sliver() {
  Mesh mesh = testing::box(Eigen::Vector3f(0.0F, 0.0F, 0.0F), Eigen::Vector3f(1.0F, 1.0F, 1.0F));
  mesh.vertices_mm.emplace_back(0.995F, 1.0F, 1.0F);  // on the edge from corner 6 to corner 7
  for (auto& triangle : mesh.triangles) {
    if (triangle == Mesh::Triangle{5, 7, 6}) triangle = {5, 7, 8};
    if (triangle == Mesh::Triangle{3, 6, 7}) triangle = {3, 8, 7};
  }
  mesh.triangles.push_back({5, 8, 6});
  mesh.triangles.push_back({3, 6, 8});
  mesh.normals = vertex_normals(mesh);
  return mesh;
}

void collapse(Mesh& mesh, std::span<const std::uint8_t> sharp) {
  SliverCandidates candidates(mesh, 0.01F, 0.005F);
  collapse_slivers(mesh, sharp, 0.01F, candidates);
  std::erase_if(mesh.triangles, is_removed);
}

TEST(CollapseSlivers, CollapsesAShortEdge) {
  Mesh mesh = box_with_sliver();
  ASSERT_EQ(testing::open_edges(mesh), 0U);
  collapse(mesh, {});
  EXPECT_EQ(mesh.triangles.size(), 12U);
  EXPECT_EQ(testing::open_edges(mesh), 0U);
}

TEST(CollapseSlivers, LeavesSharpVerticesWhereTheyAre) {
  Mesh mesh = box_with_sliver();
  std::vector<std::uint8_t> sharp(9, 1);
  sharp[8] = 0;
  collapse(mesh, sharp);
  EXPECT_EQ(mesh.triangles.size(), 12U);
  EXPECT_NEAR(testing::volume_mm3(mesh), 1.0, 1e-6);
}

TEST(CollapseSlivers, NeverClosesATube) {
  // A prism whose ends are triangles with short sides: collapsing one would pinch it.
  Mesh mesh;
  mesh.vertices_mm = {
      {0, 0, 0}, {0.001F, 0, 0}, {0, 0.001F, 0}, {0, 0, 1}, {0.001F, 0, 1}, {0, 0.001F, 1}};
  mesh.triangles = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}};
  mesh.normals = vertex_normals(mesh);
  collapse(mesh, {});
  EXPECT_EQ(mesh.triangles.size(), 6U);
}

}  // namespace
}  // namespace frangia
