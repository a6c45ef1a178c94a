#include "frangia/fusion/internal/remove_weak_rim.h"

#include <cstdint>

#include <gtest/gtest.h>

#include "support/test_meshes.h"

namespace frangia {
namespace {

/// A flat sheet that many views observed.
Mesh sheet(std::uint16_t views) {
  Mesh mesh = testing::level_grid(6, 4);
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
