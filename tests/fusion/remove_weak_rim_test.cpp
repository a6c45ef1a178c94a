#include "frangia/fusion/internal/remove_weak_rim.h"

#include <algorithm>
#include <cstdint>

#include <gtest/gtest.h>

#include "frangia/geometry/boundary_vertices.h"

namespace frangia {
namespace {

/// A flat sheet of 6 x 4 vertices, 1 mm apart, which many views observed.
Mesh sheet(std::uint16_t views) {
  constexpr std::uint32_t kWidth = 6;
  constexpr std::uint32_t kHeight = 4;
  Mesh mesh;
  for (std::uint32_t y = 0; y < kHeight; ++y) {
    for (std::uint32_t x = 0; x < kWidth; ++x)
      mesh.vertices_mm.emplace_back(static_cast<float>(x), static_cast<float>(y), 0.0F);
  }
  for (std::uint32_t y = 0; y + 1 < kHeight; ++y) {
    for (std::uint32_t x = 0; x + 1 < kWidth; ++x) {
      const std::uint32_t i = y * kWidth + x;
      mesh.triangles.push_back({i, i + 1, i + kWidth + 1});
      mesh.triangles.push_back({i, i + kWidth + 1, i + kWidth});
    }
  }
  mesh.views.assign(mesh.vertices_mm.size(), views);
  return mesh;
}

/// The same with a tooth below its lower rim.
Mesh sheet_with_tooth(std::uint16_t views, std::uint16_t views_of_tooth) {
  Mesh mesh = sheet(views);
  const auto tooth = static_cast<std::uint32_t>(mesh.vertices_mm.size());
  mesh.vertices_mm.emplace_back(2.5F, -1.0F, 0.0F);
  mesh.views.push_back(views_of_tooth);
  mesh.triangles.push_back({2, tooth, 3});
  return mesh;
}

TEST(BoundaryVertices, AreThoseThatTrianglesDoNotSurround) {
  const Mesh mesh = sheet(1);
  const auto boundary = boundary_vertices(mesh);
  EXPECT_EQ(std::count(boundary.begin(), boundary.end(), true), 16);
  EXPECT_FALSE(boundary[7]);
  EXPECT_TRUE(boundary[0]);
}

TEST(RemoveWeakRim, TakesAToothThatOneOfManyViewsObserved) {
  Mesh mesh = sheet_with_tooth(24, 1);
  remove_weak_rim(mesh);
  EXPECT_EQ(mesh.triangles, sheet(24).triangles);
}

TEST(RemoveWeakRim, KeepsWhatFewViewsObservedAsTheVerticesAroundIt) {
  Mesh all = sheet_with_tooth(2, 1);
  const auto before = all.triangles;
  remove_weak_rim(all);
  EXPECT_EQ(all.triangles, before);
  Mesh half = sheet_with_tooth(24, 9);
  remove_weak_rim(half);
  EXPECT_EQ(half.triangles, before);
}

TEST(RemoveWeakRim, KeepsInnerVerticesOfFewViews) {
  Mesh mesh = sheet(24);
  mesh.views[7] = 1;
  remove_weak_rim(mesh);
  EXPECT_EQ(mesh.triangles, sheet(24).triangles);
}

TEST(RemoveWeakRim, LeavesAMeshAloneWhoseViewsAreNotKnown) {
  Mesh mesh = sheet_with_tooth(24, 1);
  mesh.views.clear();
  const auto before = mesh.triangles;
  remove_weak_rim(mesh);
  EXPECT_EQ(mesh.triangles, before);
}

}  // namespace
}  // namespace frangia
