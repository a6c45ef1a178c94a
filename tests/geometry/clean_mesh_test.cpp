#include "frangia/geometry/clean_mesh.h"

#include <gtest/gtest.h>

#include "support/test_meshes.h"

namespace frangia {
namespace {

/// Two boxes; the second one's triangles come last.
Mesh two_boxes() {
  Mesh mesh = testing::box(Eigen::Vector3f::Zero(), Eigen::Vector3f::Ones());
  const Mesh other =
      testing::box(Eigen::Vector3f(5.0F, 0.0F, 0.0F), Eigen::Vector3f(6.0F, 1.0F, 1.0F));
  for (const auto& vertex : other.vertices_mm)
    mesh.vertices_mm.push_back(vertex);
  for (const auto& [a, b, c] : other.triangles)
    mesh.triangles.push_back({a + 8, b + 8, c + 8});
  return mesh;
}

TEST(CleanMesh, RemovesComponentsThatAreTooSmallAndTheirVertices) {
  Mesh mesh = two_boxes();
  mesh.triangles.pop_back();
  remove_small_components(mesh, 12);
  remove_unused_vertices(mesh);
  EXPECT_EQ(mesh.triangles.size(), 12U);
  EXPECT_EQ(mesh.vertices_mm.size(), 8U);
  EXPECT_NEAR(testing::volume_mm3(mesh), 1.0, 1e-6);
}

TEST(CleanMesh, KeepsComponentsThatAreLargeEnough) {
  Mesh mesh = two_boxes();
  remove_small_components(mesh, 12);
  EXPECT_EQ(mesh.triangles.size(), 24U);
}

TEST(CleanMesh, SplitsAVertexWhereTwoFansMeet) {
  Mesh mesh;
  mesh.vertices_mm = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 4}};
  split_nonmanifold_vertices(mesh);
  EXPECT_EQ(mesh.vertices_mm.size(), 6U);
  EXPECT_EQ(mesh.triangles[0][0], 0U);
  EXPECT_EQ(mesh.triangles[1][0], 5U);
  EXPECT_EQ(mesh.vertices_mm[5], mesh.vertices_mm[0]);
}

TEST(CleanMesh, LeavesAVertexWithOneFanAlone) {
  Mesh mesh;
  mesh.vertices_mm = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}};
  mesh.triangles = {{0, 2, 3}, {0, 1, 2}};
  split_nonmanifold_vertices(mesh);
  EXPECT_EQ(mesh.vertices_mm.size(), 4U);
}

TEST(CleanMesh, RemovesComponentsAndSplitsVerticesInOneCall) {
  Mesh mesh = testing::box(Eigen::Vector3f::Zero(), Eigen::Vector3f::Ones());
  for (const float x : {5.0F, 6.0F, 7.0F, 4.0F, 3.0F, 8.0F, 9.0F, 8.0F})
    mesh.vertices_mm.emplace_back(x, x * x, 0.0F);
  mesh.triangles.push_back({13, 14, 15});  // a component of one triangle
  mesh.triangles.push_back({8, 9, 10});    // two fans that meet in a vertex
  mesh.triangles.push_back({8, 11, 12});
  clean_mesh(mesh, 2);
  EXPECT_EQ(mesh.triangles.size(), 14U);
  ASSERT_EQ(mesh.vertices_mm.size(), 14U);
  EXPECT_EQ(mesh.triangles.back()[0], 13U);
  EXPECT_EQ(mesh.vertices_mm[13], mesh.vertices_mm[8]);
}

}  // namespace
}  // namespace frangia
