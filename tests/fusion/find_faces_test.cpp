#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/fusion/internal/find_feature_vertices.h"

namespace frangia {
namespace {

/// Vertices of the three faces at the corner of a cube, at 1 to 4 from its edges.
Mesh corner() {
  Mesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 1; i <= 4; ++i) {
      for (int j = 1; j <= 4; ++j) {
        Eigen::Vector3f point = Eigen::Vector3f::Zero();
        point[(axis + 1) % 3] = static_cast<float>(-i);
        point[(axis + 2) % 3] = static_cast<float>(-j);
        mesh.vertices_mm.push_back(point);
        mesh.normals.emplace_back(Eigen::Vector3f::Unit(axis));
      }
    }
  }
  mesh.sigma_mm.assign(mesh.vertices_mm.size(), 0.001F);
  return mesh;
}

Faces faces_of(const Mesh& mesh, const Eigen::Vector3f& near) {
  std::vector<std::uint32_t> all(mesh.vertices_mm.size());
  std::iota(all.begin(), all.end(), 0U);
  return find_faces(mesh, all, near, EdgeLimits({}, 1.0F));
}

TEST(FindFaces, FindsTheThreeOfACorner) {
  const Faces faces = faces_of(corner(), {-0.3F, -0.2F, -0.1F});
  ASSERT_EQ(faces.count, 3U);
  EXPECT_LT(intersect_planes(faces.planes, {-0.3F, -0.2F, -0.1F}).norm(), 1e-4F);
}

TEST(FindFaces, ListsTheNearestFaceFirst) {
  const Faces faces = faces_of(corner(), {-0.3F, -0.2F, -0.1F});
  ASSERT_EQ(faces.count, 3U);
  EXPECT_GT(faces.planes[0].normal().z(), 0.999F);
  EXPECT_GT(faces.planes[2].normal().x(), 0.999F);
  const Eigen::Vector3f edge =
      intersect_planes(faces.planes[0], faces.planes[1], {-0.3F, -0.2F, -0.1F});
  EXPECT_LT((edge - Eigen::Vector3f(-0.3F, 0.0F, 0.0F)).norm(), 1e-4F);
}

TEST(FindFaces, FindsNoFaceInARoughSurface) {
  Mesh mesh = corner();
  for (std::size_t i = 0; i < mesh.vertices_mm.size(); ++i)
    mesh.vertices_mm[i] += (i % 2 == 0 ? 0.1F : -0.1F) * mesh.normals[i];
  EXPECT_EQ(faces_of(mesh, Eigen::Vector3f::Zero()).count, 0U);
}

}  // namespace
}  // namespace frangia
