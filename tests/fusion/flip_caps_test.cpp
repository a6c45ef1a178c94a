#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "frangia/fusion/internal/remove_slivers.h"

namespace frangia {
namespace {

/// A triangle over a second one whose lower corner is `sag` above their common edge.
Mesh square(float sag) {
  Mesh mesh;
  mesh.vertices_mm = {{-1, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, sag, 0}};
  mesh.triangles = {{0, 1, 2}, {1, 0, 3}};
  mesh.normals.assign(4, Eigen::Vector3f::UnitZ());
  return mesh;
}

TEST(FlipCaps, FlipsTheLongEdgeOfACap) {
  Mesh mesh = square(0.001F);  // it is folded over, too
  SliverCandidates candidates(mesh, 0.0F, 0.1F);
  EXPECT_TRUE(flip_caps(mesh, 0.1F, candidates));
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3f cross = (mesh.vertices_mm[t[1]] - mesh.vertices_mm[t[0]])
                                      .cross(mesh.vertices_mm[t[2]] - mesh.vertices_mm[t[0]]);
    EXPECT_GT(cross.z(), 0.5F);
  }
}

TEST(FlipCaps, LeavesTrianglesThatAreHighEnough) {
  Mesh mesh = square(-0.5F);
  const auto before = mesh.triangles;
  SliverCandidates all(mesh, 10.0F, 10.0F);
  EXPECT_FALSE(flip_caps(mesh, 0.1F, all));
  EXPECT_EQ(mesh.triangles, before);
}

}  // namespace
}  // namespace frangia
