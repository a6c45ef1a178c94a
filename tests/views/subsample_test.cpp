#include <gtest/gtest.h>

#include "frangia/core/error.h"
#include "frangia/views/thin_view.h"

namespace frangia {
namespace {

const CameraModel kCameraModel{.width_px = 11,
                               .height_px = 8,
                               .focal_px = {20.0, 21.0},
                               .principal_point_px = {5.2, 3.9},
                               .distortion = {-0.09, 0.05, 4e-4, -3e-4, 0.01}};

TEST(Subsample, KeepsEachPixelsRayAndPoint) {
  View view;
  view.range.depth_mm = Image<float>(11, 8);
  view.range.sigma_mm = Image<float>(11, 8);
  view.range.phase_rad = Image<float>(11, 8);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 11; ++x) {
      view.range.depth_mm(x, y) = static_cast<float>(100 * y + x);
      view.range.sigma_mm(x, y) = static_cast<float>(x - y);
      view.range.phase_rad(x, y) = static_cast<float>(x + 20 * y);
    }
  }
  const CameraModel model = subsample(kCameraModel, 3);
  const View thin = subsample(view, 3);
  ASSERT_EQ(model.width_px, 4);
  ASSERT_EQ(model.height_px, 3);
  ASSERT_EQ(thin.range.depth_mm.width(), 4);
  ASSERT_EQ(thin.range.depth_mm.height(), 3);
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 4; ++x) {
      EXPECT_EQ(thin.range.depth_mm(x, y), view.range.depth_mm(3 * x, 3 * y));
      EXPECT_EQ(thin.range.sigma_mm(x, y), view.range.sigma_mm(3 * x, 3 * y));
      EXPECT_EQ(thin.range.phase_rad(x, y), view.range.phase_rad(3 * x, 3 * y));
      const Eigen::Vector2d all = kCameraModel.ray(Eigen::Vector2d(3 * x, 3 * y));
      EXPECT_NEAR((model.ray(Eigen::Vector2d(x, y)) - all).norm(), 0.0, 1e-12);
    }
  }
}

TEST(Subsample, RefusesAStepOfZero) {
  EXPECT_THROW(static_cast<void>(subsample(kCameraModel, 0)), Error);
  EXPECT_THROW(static_cast<void>(subsample(View{}, 0)), Error);
}

}  // namespace
}  // namespace frangia
