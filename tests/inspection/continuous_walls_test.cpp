// Walls between which the thickness does not jump.
#include "frangia/inspection/internal/continuous_walls.h"

#include <gtest/gtest.h>

#include "support/test_meshes.h"

namespace frangia {
namespace {

TEST(ContinuousWalls, EndWhereTheThicknessChangesMoreThanWallsIncline) {
  const Mesh mesh = testing::level_grid(20, 10);
  Thickness walls;
  for (const Eigen::Vector3f& at : mesh.vertices_mm)
    walls.thickness_mm.push_back(at.x() < 9.5F ? 5.0F + at.x() : 60.0F);
  std::vector<bool> counts(mesh.vertices_mm.size(), true);
  const auto found = inspection::continuous_walls(mesh, walls, counts);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].size(), 100U);
  EXPECT_EQ(found[1].size(), 100U);
  // Vertices that are not asked for part a wall, too.
  for (std::size_t v = 0; v < counts.size(); ++v)
    counts[v] = mesh.vertices_mm[v].x() < 3.5F || mesh.vertices_mm[v].x() > 4.5F;
  EXPECT_EQ(inspection::continuous_walls(mesh, walls, counts).size(), 3U);
  // Noise as large as the jump joins what may be one wall.
  walls.u_mm.assign(mesh.vertices_mm.size(), 20.0F);
  EXPECT_EQ(inspection::continuous_walls(mesh, walls, counts).size(), 2U);
}

}  // namespace
}  // namespace frangia
