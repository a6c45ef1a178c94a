#include "frangia/fusion/internal/remove_slivers.h"

#include <gtest/gtest.h>

#include "support/test_meshes.h"

namespace frangia {
namespace {

/// A grid of squares, each cut in two, with displaced inner vertices.
Mesh rough_sheet() {
  constexpr std::uint32_t kGridSide = 20;
  Mesh mesh;
  for (std::uint32_t i = 0; i < kGridSide * kGridSide; ++i) {
    const std::uint32_t column = i % kGridSide;
    const std::uint32_t row = i / kGridSide;
    const auto x = static_cast<float>(column);
    const auto y = static_cast<float>(row);
    const bool inside = x > 0.0F && y > 0.0F && x + 1.0F < kGridSide && y + 1.0F < kGridSide;
    const float push = inside ? 0.48F : 0.0F;
    mesh.vertices_mm.emplace_back(
        x + push * std::sin(5.0F * x + 3.0F * y), y + push * std::cos(2.0F * x - 7.0F * y), 0.0F);
  }
  for (std::uint32_t y = 0; y + 1 < kGridSide; ++y) {
    for (std::uint32_t x = 0; x + 1 < kGridSide; ++x) {
      const std::uint32_t i = y * kGridSide + x;
      mesh.triangles.push_back({i, i + 1, i + kGridSide});
      mesh.triangles.push_back({i + 1, i + kGridSide + 1, i + kGridSide});
    }
  }
  mesh.normals.assign(mesh.vertices_mm.size(), Eigen::Vector3f::UnitZ());
  return mesh;
}

TEST(RemoveSlivers, LeavesFewerSliversAndNoHole) {
  Mesh mesh = rough_sheet();
  const std::size_t open = testing::open_edges(mesh);
  const std::size_t candidates = SliverCandidates(mesh, 0.4F, 0.2F).triangles().size();
  ASSERT_GT(candidates, 50U);
  remove_slivers(mesh, {}, 0.2F);
  EXPECT_LT(SliverCandidates(mesh, 0.4F, 0.2F).triangles().size(), candidates * 2 / 3);
  EXPECT_EQ(testing::open_edges(mesh), open);
  for (const Mesh::Triangle& t : mesh.triangles)
    EXPECT_NE(t[0], t[1]);
}

}  // namespace
}  // namespace frangia
