#include "frangia/indirect_light/surface_sight.h"

#include <cmath>
#include <cstddef>

#include <gtest/gtest.h>

#include "support/test_meshes.h"
#include "support/two_walls.h"

namespace frangia {
namespace {

constexpr double kStepOff_mm = 1e-3;

double share_that_sees(Mesh mesh) {
  const std::size_t count = mesh.triangles.size();
  const RayScene scene(std::move(mesh));
  const SurfaceSight sight(scene, kStepOff_mm);
  std::size_t sees = 0;
  for (std::size_t i = 0; i < count; ++i)
    sees += sight.sees_surface(i) ? 1U : 0U;
  return static_cast<double>(sees) / static_cast<double>(count);
}

TEST(SurfaceSight, SeesNothingFromASphereOrAPlane) {
  EXPECT_EQ(share_that_sees(testing::sphere({1.0, 2.0, 3.0}, 40.0)), 0.0);
  EXPECT_EQ(share_that_sees(testing::level_grid(60, 60)), 0.0);
}

TEST(SurfaceSight, SeesTheOtherWallAndFromFarAwayNothing) {
  // A level sheet with a wall along one of its edges.
  constexpr std::uint32_t kSide = 60;
  Mesh mesh = testing::level_grid(kSide, kSide);
  const auto sheet = mesh.triangles.size();
  for (std::uint32_t i = 0; i < kSide; ++i) {
    for (const float height : {0.0F, 1.0F, 2.0F, 3.0F, 4.0F})
      mesh.vertices_mm.emplace_back(0.0F, static_cast<float>(i), height);
  }
  for (std::uint32_t i = 0; i + 1 < kSide; ++i) {
    for (std::uint32_t k = 0; k < 4; ++k) {
      const std::uint32_t low = kSide * kSide + 5 * i + k;
      mesh.triangles.push_back({low, low + 5, low + 6});
      mesh.triangles.push_back({low, low + 6, low + 1});
    }
  }
  const RayScene scene(mesh);
  const SurfaceSight sight(scene, kStepOff_mm);
  const auto sees_at = [&](float x) {
    for (std::size_t i = 0; i < sheet; ++i) {
      const Eigen::Vector3f& corner = mesh.vertices_mm[mesh.triangles[i][0]];
      if (corner.x() == x && corner.y() == 30.0F) return sight.sees_surface(i);
    }
    return false;
  };
  EXPECT_TRUE(sees_at(2.0F));
  EXPECT_FALSE(sees_at(55.0F));
  EXPECT_EQ(share_that_sees(testing::two_walls(50.0)), 1.0);  // triangles longer than its cells
}

}  // namespace
}  // namespace frangia
