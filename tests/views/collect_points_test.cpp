#include <cmath>

#include <gtest/gtest.h>

#include "frangia/views/view_store.h"

#include "support/analytic_views.h"

namespace frangia {
namespace {

TEST(CollectPoints, GathersEveryPointWithItsSigmaInTheObjectFrame) {
  const auto camera = testing::small_camera_model(120, 600.0);
  const ViewStore views =
      testing::snapshots(testing::sphere(40.0), camera, testing::around_table(3, 0.3, 650.0));
  std::size_t measured = 0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const View view = views.load(i);
    for (const float depth : view.range.depth_mm.pixels())
      measured += std::isnan(depth) ? 0U : 1U;
  }
  const PointCloud cloud = collect_points(views, camera);
  ASSERT_EQ(cloud.points_mm.size(), measured);
  ASSERT_EQ(cloud.sigma_mm.size(), measured);
  for (std::size_t i = 0; i < measured; ++i) {
    EXPECT_NEAR(cloud.points_mm[i].norm(), 40.0F, 1.0F);
    EXPECT_GT(cloud.sigma_mm[i], 0.0F);
  }
}

}  // namespace
}  // namespace frangia
