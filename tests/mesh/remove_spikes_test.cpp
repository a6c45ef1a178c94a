#include "frangia/mesh/remove_spikes.h"

#include <cmath>

#include <gtest/gtest.h>

#include "files/sample_meshes.h"
#include "support/test_meshes.h"

namespace frangia {
namespace {

TEST(RemoveSpikes, FlattensATipAndKeepsTheRest) {
  constexpr float kSphereRadius = 20.0F;
  Mesh mesh = testing::sphere(Eigen::Vector3d::Zero(), kSphereRadius, 40);
  mesh.vertices_mm[1000] *= 2.0F;
  const Mesh flat = remove_spikes(mesh);
  for (const auto& vertex : flat.vertices_mm)
    ASSERT_NEAR(vertex.norm(), kSphereRadius, 0.2F);
  EXPECT_EQ(flat.vertex_marks[1000], Mark::Displaced);
}

TEST(RemoveSpikes, KeepsTheCornersOfABoxAndTheBoundaryOfASheet) {
  for (const Mesh& mesh :
       {testing::box(Eigen::Vector3f::Zero(), Eigen::Vector3f::Ones()), testing::sheet(21)}) {
    const Mesh same = remove_spikes(mesh);
    EXPECT_EQ(same.vertices_mm, mesh.vertices_mm);
    EXPECT_EQ(same.triangles, mesh.triangles);
  }
}

TEST(RemoveSpikes, RemovesNeedlesAtTheBoundary) {
  const Mesh sheet = testing::sheet(21);
  Mesh mesh = sheet;
  mesh.vertices_mm[10].y() -= 8.0F;        // in the plane of the sheet
  mesh.vertices_mm[210].z() += 8.0F;       // perpendicular to the sheet
  mesh.vertices_mm[211 + 63].z() += 8.0F;  // in the middle of the sheet
  const Mesh repaired = remove_spikes(mesh);
  for (const auto& vertex : repaired.vertices_mm) {
    EXPECT_LT(std::abs(vertex.z()), 0.5F);
    EXPECT_GE(vertex.y(), 0.0F);
  }
  EXPECT_EQ(repaired.triangles.size() + 6, sheet.triangles.size());  // three at each
  EXPECT_EQ(repaired.vertices_mm.size() + 2, sheet.vertices_mm.size());
}

TEST(RemoveSpikes, AcceptsAnEmptyMesh) {
  EXPECT_TRUE(remove_spikes(Mesh{}).vertices_mm.empty());
}

}  // namespace
}  // namespace frangia
