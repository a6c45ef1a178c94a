#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/fusion/internal/sharpen_edges.h"

#include "support/test_meshes.h"

namespace frangia {
namespace {

constexpr float kNoise = 0.01F;
constexpr float kBend = 0.05F;
constexpr std::uint32_t kMiddle = 4 * 9 + 4;

/// A grid of 1 mm with normals along z, a sigma of noise and bend, and a vertex that rises.
PlacedVertices grid(float rise_mm, std::uint8_t sharp) {
  PlacedVertices placed;
  placed.mesh = testing::level_grid(9, 9);
  const std::size_t count = placed.mesh.vertices_mm.size();
  placed.mesh.vertices_mm[kMiddle].z() += rise_mm;
  placed.mesh.normals.assign(count, Eigen::Vector3f::UnitZ());
  placed.mesh.sigma_mm.assign(count, std::hypot(kNoise, kBend));
  placed.bend_mm.assign(count, kBend);
  placed.sharp.assign(count, sharp);
  return placed;
}

float settled(PlacedVertices placed, std::uint8_t on_edge) {
  settle_bends(placed, std::vector<std::uint8_t>(placed.bend_mm.size(), on_edge));
  return placed.mesh.sigma_mm[kMiddle];
}

TEST(SettleBends, OfAFaceCountAsFarAsTheVerticesAroundShowThem) {
  EXPECT_NEAR(settled(grid(0.0F, 0), 0), kNoise, 1e-6F);
  // A range of 0.05, evenly distributed.
  EXPECT_NEAR(settled(grid(0.1F, 0), 0), std::hypot(kNoise, 0.05F / std::sqrt(12.0F)), 1e-5F);
  EXPECT_NEAR(settled(grid(0.2F, 0), 0), std::hypot(kNoise, 0.1F / std::sqrt(12.0F)), 1e-5F);
}

TEST(SettleBends, AreAStepWhereTheVerticesAroundLieElsewhere) {
  EXPECT_NEAR(settled(grid(0.5F, 0), 0), std::hypot(kNoise, 0.5F / std::sqrt(12.0F)), 1e-4F);
}

TEST(SettleBends, BetweenFacesAndOnAnEdgeStay) {
  EXPECT_EQ(settled(grid(1.0F, 1), 0), std::hypot(kNoise, kBend));
  EXPECT_EQ(settled(grid(1.0F, 0), 2), std::hypot(kNoise, kBend));
}

}  // namespace
}  // namespace frangia
