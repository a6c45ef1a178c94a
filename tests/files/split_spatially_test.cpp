#include "frangia/files/internal/split_spatially.h"

#include <algorithm>
#include <numeric>
#include <set>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "frangia/core/error.h"

#include "files/sample_meshes.h"

namespace frangia {
namespace {

std::vector<std::uint32_t> all_of(const Mesh& mesh) {
  std::vector<std::uint32_t> triangles(mesh.triangles.size());
  std::iota(triangles.begin(), triangles.end(), 0U);
  return triangles;
}

TEST(SplitSpatially, PutsEachTriangleIntoOneGroupWithinTheLimits) {
  const Mesh mesh = testing::sheet(40);
  std::vector<std::uint32_t> seen;
  for (const auto& group : split_spatially(mesh, all_of(mesh), 100)) {
    std::set<std::uint32_t> vertices;
    for (const auto triangle : group)
      vertices.insert(mesh.triangles[triangle].begin(), mesh.triangles[triangle].end());
    EXPECT_LE(group.size(), 100U);
    EXPECT_LE(vertices.size(), 100U);
    EXPECT_TRUE(std::is_sorted(group.begin(), group.end()));
    seen.insert(seen.end(), group.begin(), group.end());
  }
  std::sort(seen.begin(), seen.end());
  EXPECT_EQ(seen, all_of(mesh));
}

TEST(SplitSpatially, DoesNotSplitWhatFitsInOneGroup) {
  const Mesh mesh = testing::sheet(5);
  EXPECT_EQ(split_spatially(mesh, all_of(mesh), 32).size(), 1U);
}

TEST(SplitSpatially, LimitsTheVerticesOfUnconnectedTriangles) {
  Mesh loose;
  for (std::uint32_t i = 0; i < 40; ++i) {
    for (int corner = 0; corner < 3; ++corner)
      loose.vertices_mm.emplace_back(static_cast<float>(i), static_cast<float>(corner), 0.0F);
    loose.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  for (const auto& group : split_spatially(loose, all_of(loose), 40))
    EXPECT_LE(group.size(), 13U);
}

TEST(SplitSpatially, MakesCompactGroups) {
  const Mesh mesh = testing::sheet(60);
  const auto area_of = [&](const std::vector<std::uint32_t>& group) {
    Eigen::AlignedBox2f box;
    for (const auto triangle : group) {
      for (const auto corner : mesh.triangles[triangle])
        box.extend(mesh.vertices_mm[corner].head<2>());
    }
    return box.volume();
  };
  float sum = 0.0F;
  for (const auto& group : split_spatially(mesh, all_of(mesh), 500))
    sum += area_of(group);
  EXPECT_LT(sum, 1.2F * area_of(all_of(mesh)));
}

TEST(SplitSpatially, RefusesALimitBelowThree) {
  const Mesh mesh = testing::sheet(3);
  EXPECT_THROW(static_cast<void>(split_spatially(mesh, all_of(mesh), 2)), Error);
}

}  // namespace
}  // namespace frangia
