#include <algorithm>
#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include "frangia/fusion/internal/remove_weak_rim.h"

#include "support/test_meshes.h"

namespace frangia {
namespace {

Mesh band(std::uint32_t width, std::uint16_t views) {
  Mesh mesh = testing::level_grid(20, width);
  mesh.views.assign(mesh.vertices_mm.size(), views);
  mesh.sigma_mm.assign(mesh.vertices_mm.size(), 0.01F);
  return mesh;
}

TEST(NarrowStrips, OfOneViewAreUncertainByAThirdOfAVoxel) {
  Mesh mesh = band(4, 1);
  widen_sigma_of_strips(mesh, 0.5F);
  for (const float sigma : mesh.sigma_mm)
    EXPECT_FLOAT_EQ(sigma, std::hypot(0.01F, 0.15F));
}

TEST(NarrowStrips, OfSeveralViewsOrWideOnesStayAsTheyAre) {
  Mesh confirmed = band(4, 2);
  widen_sigma_of_strips(confirmed, 0.5F);
  EXPECT_EQ(confirmed.sigma_mm, band(4, 2).sigma_mm);
  Mesh wide = band(7, 1);
  widen_sigma_of_strips(wide, 0.5F);
  // All but its corners.
  EXPECT_GE(std::count(wide.sigma_mm.begin(), wide.sigma_mm.end(), 0.01F), 20 * 7 - 8);
}

TEST(NarrowStrips, StayAsTheyAreWhereNoNumberOfViewsIsKnown) {
  Mesh mesh = band(4, 1);
  mesh.views.clear();
  widen_sigma_of_strips(mesh, 0.5F);
  EXPECT_EQ(mesh.sigma_mm, band(4, 1).sigma_mm);
}

}  // namespace
}  // namespace frangia
