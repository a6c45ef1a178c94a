#include "frangia/surface/smooth_out.h"

#include <gtest/gtest.h>

#include "frangia/surface/rough_triangles.h"

#include "support/mesh_truths.h"

namespace frangia {
namespace {

/// A grid of squares, each cut in two, whose inner vertices were pushed about.
Mesh rough_sheet() {
  constexpr std::uint32_t kSide = 20;
  Mesh mesh;
  for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
    const std::uint32_t column = i % kSide;
    const std::uint32_t row = i / kSide;
    const auto x = static_cast<float>(column);
    const auto y = static_cast<float>(row);
    const bool inside = x > 0.0F && y > 0.0F && x + 1.0F < kSide && y + 1.0F < kSide;
    const float push = inside ? 0.48F : 0.0F;
    mesh.vertices_mm.emplace_back(
        x + push * std::sin(5.0F * x + 3.0F * y), y + push * std::cos(2.0F * x - 7.0F * y), 0.0F);
  }
  for (std::uint32_t y = 0; y + 1 < kSide; ++y) {
    for (std::uint32_t x = 0; x + 1 < kSide; ++x) {
      const std::uint32_t i = y * kSide + x;
      mesh.triangles.push_back({i, i + 1, i + kSide});
      mesh.triangles.push_back({i + 1, i + kSide + 1, i + kSide});
    }
  }
  mesh.normals.assign(mesh.vertices_mm.size(), Eigen::Vector3f::UnitZ());
  return mesh;
}

TEST(SmoothOut, LeavesFewerRoughTrianglesAndNoHole) {
  Mesh mesh = rough_sheet();
  const std::size_t open = testing::open_edges(mesh);
  const std::size_t rough = RoughTriangles(mesh, 0.4F, 0.2F).triangles().size();
  ASSERT_GT(rough, 50U);
  smooth_out(mesh, {}, 0.2F);
  EXPECT_LT(RoughTriangles(mesh, 0.4F, 0.2F).triangles().size(), rough * 2 / 3);
  EXPECT_EQ(testing::open_edges(mesh), open);
  for (const Mesh::Triangle& t : mesh.triangles)
    EXPECT_NE(t[0], t[1]);
}

}  // namespace
}  // namespace frangia
