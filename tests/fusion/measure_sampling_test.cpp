#include <gtest/gtest.h>

#include "frangia/fusion/internal/sampling.h"

#include "support/analytic_views.h"

namespace frangia {
namespace {

TEST(MeasureSampling, MeasuresTheSpacingOfPixelsOnTheObject) {
  const CameraRays camera(testing::small_camera_model());
  const ViewStore views = testing::snapshots(testing::floor_at(0.0),
                                             camera.model,
                                             {testing::look_from(0.0, 1.57, 600.0)},
                                             {.sigma_mm = 0.013});
  const Sampling sampling = measure_sampling(views, camera);
  EXPECT_NEAR(sampling.spacing_mm, 600.0 / 1500.0, 0.02);
  EXPECT_NEAR(sampling.sigma_mm, 0.013, 1e-6);
  EXPECT_NEAR(static_cast<double>(sampling.points), 300.0 * 300.0, 5000.0);
}

TEST(MeasureSampling, FindsNothingInViewsWithoutAPoint) {
  const CameraRays camera(testing::small_camera_model());
  ViewStore views;
  views.add({{Image<float>(300, 300, kMissing), Image<float>(300, 300, kMissing)}, {}});
  EXPECT_EQ(measure_sampling(views, camera).points, 0U);
}

}  // namespace
}  // namespace frangia
