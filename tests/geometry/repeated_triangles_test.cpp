#include <limits>

#include <gtest/gtest.h>

#include "frangia/geometry/clean_mesh.h"

#include "support/test_meshes.h"

namespace frangia {
namespace {

using testing::box;

TEST(RepeatedTriangles, AreNotFoundInASoundMesh) {
  EXPECT_TRUE(repeated_triangles(box({-1, -1, -1}, {1, 1, 1})).empty());
  EXPECT_TRUE(repeated_triangles({}).empty());
}

TEST(RepeatedTriangles, AreFoundInAnyOrderOfCornersAndOfOtherVertices) {
  Mesh mesh;
  mesh.vertices_mm = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0F, 1, 0}, {1, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {1, 2, 4}, {2, 1, 0}, {1, 3, 0}, {0, 1, 4}};
  EXPECT_EQ(repeated_triangles(mesh), (std::vector<std::uint32_t>{2, 3}));
}

TEST(RepeatedTriangles, IgnorePositionsThatAreNotFinite) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  Mesh mesh;
  mesh.vertices_mm = {{0, 0, 0}, {1, 0, 0}, {nan, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 1, 2}};
  EXPECT_TRUE(repeated_triangles(mesh).empty());
}

}  // namespace
}  // namespace frangia
