#include "frangia/geometry/pick_surface.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support/test_meshes.h"

namespace frangia {
namespace {

TEST(PickSurface, FindsTheNearSideOfABoxAndItsLargestSigma) {
  Mesh box = testing::box({-1, -1, -1}, {1, 1, 1});
  for (std::size_t i = 0; i < box.vertices_mm.size(); ++i)
    box.sigma_mm.push_back(box.vertices_mm[i].x() > 0.0F ? 0.02F : 0.5F);
  const auto hit = pick_surface(box, {.eye_mm = {9, 0.2, 0.3}, .direction = {-2, 0, 0}});
  ASSERT_TRUE(hit.has_value());
  EXPECT_TRUE(hit->point_mm.isApprox(Eigen::Vector3d(1, 0.2, 0.3)));
  EXPECT_FLOAT_EQ(static_cast<float>(hit->sigma_mm), 0.02F);
  for (const std::uint32_t vertex : box.triangles[hit->triangle])
    EXPECT_EQ(box.vertices_mm[vertex].x(), 1.0F);
}

TEST(PickSurface, PassesWhatASectionCutsAwayAndMeetsTheInside) {
  const Mesh box = testing::box({-1, -1, -1}, {1, 1, 1});
  // What is above x = 0 is cut away.
  const auto hit = pick_surface(box,
                                {.eye_mm = {9, 0.2, 0.3},
                                 .direction = {-1, 0, 0},
                                 .section_normal = {-1, 0, 0},
                                 .section_offset_mm = 0.0});
  ASSERT_TRUE(hit.has_value());
  EXPECT_TRUE(hit->point_mm.isApprox(Eigen::Vector3d(-1, 0.2, 0.3)));
  EXPECT_TRUE(std::isnan(hit->sigma_mm));
}

TEST(PickSurface, MeetsNothingBesideTheSurfaceNorBehindTheEye) {
  const Mesh box = testing::box({-1, -1, -1}, {1, 1, 1});
  EXPECT_FALSE(pick_surface(box, {.eye_mm = {9, 2, 0}, .direction = {-1, 0, 0}}).has_value());
  EXPECT_FALSE(pick_surface(box, {.eye_mm = {9, 0, 0}, .direction = {1, 0, 0}}).has_value());
  EXPECT_FALSE(pick_surface({}, {}).has_value());
}

}  // namespace
}  // namespace frangia
