#include "frangia/geometry/corner_normals.h"

#include <gtest/gtest.h>

#include "support/test_meshes.h"

namespace frangia {
namespace {

TEST(CornerNormals, AreRadialOnASphere) {
  const Mesh mesh = testing::sphere({0, 0, 0}, 20.0, 60);
  const auto normals = corner_normals(mesh);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Eigen::Vector3f out = mesh.vertices_mm[mesh.triangles[i][corner]] / 20.0F;
      EXPECT_GT(normals[i][corner].dot(out), 0.9995F);
    }
  }
}

TEST(CornerNormals, KeepTheEdgesOfABoxSharp) {
  const Mesh mesh = testing::box({0, 0, 0}, {1, 2, 3});
  const auto normals = corner_normals(mesh);
  for (const auto& corners : normals) {
    for (const auto& normal : corners) {
      EXPECT_NEAR(normal.cwiseAbs().maxCoeff(), 1.0F, 1e-6F);
      EXPECT_NEAR((normal - corners[0]).norm(), 0.0F, 1e-6F);
    }
  }
}

TEST(CornerNormals, AreSmoothedAcrossEdgesBelowTheCreaseAngle) {
  const auto normals = corner_normals(testing::box({-1, -1, -1}, {1, 1, 1}), rad_from_deg(100.0));
  for (const auto& corners : normals) {
    for (const auto& normal : corners)
      EXPECT_NEAR(normal.cwiseAbs().minCoeff(), std::sqrt(1.0F / 3.0F), 1e-5F);
  }
}

TEST(CornerNormals, AreZeroForATriangleWithoutArea) {
  Mesh mesh = testing::box({0, 0, 0}, {1, 1, 1});
  mesh.triangles.push_back({0, 1, 1});
  const auto normals = corner_normals(mesh);
  EXPECT_TRUE(normals.back()[0].isZero());
  EXPECT_NEAR(normals.front()[0].norm(), 1.0F, 1e-6F);
}

}  // namespace
}  // namespace frangia
