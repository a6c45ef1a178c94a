#include <algorithm>

#include <gtest/gtest.h>

#include "frangia/geometry/boundary.h"

#include "support/test_meshes.h"

namespace frangia {
namespace {

TEST(BoundaryVertices, AreThoseThatTrianglesDoNotSurround) {
  const auto boundary = boundary_vertices(testing::level_grid(6, 4));
  EXPECT_EQ(std::count(boundary.begin(), boundary.end(), true), 16);
  EXPECT_FALSE(boundary[7]);
  EXPECT_TRUE(boundary[0]);
}

TEST(BoundaryVertices, ClosedMeshesAndUnusedVerticesHaveNone) {
  Mesh mesh = testing::box({0, 0, 0}, {1, 1, 1});
  mesh.vertices_mm.emplace_back(2.0F, 2.0F, 2.0F);
  const auto boundary = boundary_vertices(mesh);
  EXPECT_EQ(std::count(boundary.begin(), boundary.end(), true), 0);
}

}  // namespace
}  // namespace frangia
