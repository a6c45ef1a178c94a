#include "frangia/service/display_level.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "frangia/geometry/ray_scene.h"

#include "support/test_meshes.h"

namespace frangia {
namespace {

constexpr double kRadius = 10.0;

TEST(DisplayLevel, IsTheMeshItselfWhereThatIsSmallEnough) {
  const Mesh ball = testing::sphere({0, 0, 0}, kRadius, 20);
  const DisplayLevel level = display_level(ball, ball.triangles.size());
  EXPECT_TRUE(level.exact);
  EXPECT_EQ(level.error_mm, 0.0);
}

TEST(DisplayLevel, TakesVerticesOfTheMeshAndStaysWithinItsError) {
  const Mesh ball = testing::sphere({0, 0, 0}, kRadius, 120);
  constexpr std::size_t kMost = 3000;
  const DisplayLevel level = display_level(ball, kMost);
  EXPECT_FALSE(level.exact);
  EXPECT_LE(level.triangles.size(), kMost);
  EXPECT_GT(level.triangles.size(), kMost / 2);
  EXPECT_TRUE(std::is_sorted(level.vertices.begin(), level.vertices.end()));
  Mesh coarse;
  coarse.vertices_mm = values_of_level(ball.vertices_mm, level);
  coarse.triangles = level.triangles;
  for (const Eigen::Vector3f& vertex : coarse.vertices_mm)
    EXPECT_NEAR(vertex.norm(), kRadius, 1e-4) << "a vertex of the mesh";
  const RayScene scene(coarse);
  double farthest = 0.0;
  for (std::size_t i = 0; i < ball.vertices_mm.size(); i += 7)
    farthest = std::max(farthest, scene.nearest(ball.vertices_mm[i].cast<double>())->distance_mm);
  EXPECT_GT(level.error_mm, 0.0);
  EXPECT_LT(farthest, 0.01 * kRadius);
}

TEST(DisplayLevel, ShowsASelectionWhereItIs) {
  const Mesh ball = testing::sphere({0, 0, 0}, kRadius, 120);
  Selection upper(ball.triangles.size());
  for (std::size_t i = 0; i < upper.size(); ++i) {
    float lowest = kRadius;
    for (const std::uint32_t vertex : ball.triangles[i])
      lowest = std::min(lowest, ball.vertices_mm[vertex].z());
    upper[i] = lowest > 0.0F ? 1 : 0;
  }
  const DisplayLevel level = display_level(ball, 3000);
  const Selection shown = selection_of_level(ball, upper, level);
  ASSERT_EQ(shown.size(), level.triangles.size());
  for (std::size_t i = 0; i < shown.size(); ++i) {
    float lowest = kRadius;
    for (const std::uint32_t vertex : level.triangles[i])
      lowest = std::min(lowest, ball.vertices_mm[level.vertices[vertex]].z());
    EXPECT_EQ(shown[i] != 0, lowest > 0.0F) << lowest;
  }
  EXPECT_TRUE(selection_of_level(ball, {}, level).empty());
}

}  // namespace
}  // namespace frangia
