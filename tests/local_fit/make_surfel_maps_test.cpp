#include <algorithm>

#include <gtest/gtest.h>

#include "frangia/core/error.h"
#include "frangia/local_fit/surfel_map.h"

#include "support/analytic_views.h"

namespace frangia {
namespace {

TEST(MakeSurfelMaps, MakesTheMapOfEachView) {
  const CameraModel camera = testing::small_camera_model(120, 600.0);
  const ViewStore views =
      testing::snapshots(testing::sphere(40.0), camera, testing::around_table(3, 0.3, 650.0));
  const auto maps = make_surfel_maps(views, camera, 4000);
  ASSERT_EQ(maps.size(), 3U);
  const CameraRays rays(camera);
  for (std::size_t i = 0; i < 3; ++i) {
    const SurfelMap alone = make_surfel_map(local_planes(views.load(i), rays), rays, 4000);
    ASSERT_EQ(maps[i].stride, alone.stride);
    EXPECT_TRUE(std::equal(maps[i].surfels.pixels().begin(),
                           maps[i].surfels.pixels().end(),
                           alone.surfels.pixels().begin(),
                           [](const SurfelMap::Surfel& a, const SurfelMap::Surfel& b) {
                             return a.point_mm == b.point_mm && a.normal == b.normal &&
                                    a.sigma_mm == b.sigma_mm;
                           }));
  }
}

TEST(SurfelBudget, BoundsTheSurfelsOfAllViews) {
  EXPECT_EQ(surfel_budget(250000, 1), 250000U);
  EXPECT_EQ(surfel_budget(250000, 24), 250000U);
  for (const std::size_t views : {48U, 96U, 360U})
    EXPECT_LE(views * surfel_budget(250000, views), 24U * 250000U) << views;
  EXPECT_EQ(surfel_budget(40000, 96), 40000U);
}

TEST(MakeSurfelMaps, RefusesACameraOfAnotherSize) {
  const ViewStore views = testing::snapshots(testing::sphere(40.0),
                                             testing::small_camera_model(120, 600.0),
                                             testing::around_table(1, 0.3, 650.0));
  EXPECT_THROW(static_cast<void>(make_surfel_maps(views, testing::small_camera_model(110, 600.0))),
               Error);
}

}  // namespace
}  // namespace frangia
