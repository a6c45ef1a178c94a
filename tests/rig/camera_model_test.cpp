#include "frangia/rig/camera_model.h"

#include <cmath>

#include <gtest/gtest.h>

namespace frangia {
namespace {

const CameraModel kCameraModel{.width_px = 640,
                               .height_px = 512,
                               .focal_px = {1200.0, 1190.0},
                               .principal_point_px = {326.8, 251.4},
                               .distortion = {-0.09, 0.05, 4e-4, -3e-4, 0.01}};

TEST(CameraModel, ProjectsAsOpenCvDoes) {
  // cv2.projectPoints of (30, -20, 400) with the same matrix and coefficients.
  const Eigen::Vector2d n(0.075, -0.05);
  const double r2 = 0.008125;
  const double radial = 1.0 - 0.09 * r2 + 0.05 * r2 * r2 + 0.01 * r2 * r2 * r2;
  const double x = n.x() * radial + 2 * 4e-4 * n.x() * n.y() - 3e-4 * (r2 + 2 * n.x() * n.x());
  const double y = n.y() * radial + 4e-4 * (r2 + 2 * n.y() * n.y()) - 2 * 3e-4 * n.x() * n.y();
  const Eigen::Vector2d pixel = kCameraModel.project({30.0, -20.0, 400.0});
  EXPECT_NEAR(pixel.x(), 1200.0 * x + 326.8, 1e-9);
  EXPECT_NEAR(pixel.y(), 1190.0 * y + 251.4, 1e-9);
}

TEST(CameraModel, RayOfAPixelProjectsBackToThePixel) {
  for (int y = 0; y < kCameraModel.height_px; y += 73) {
    for (int x = 0; x < kCameraModel.width_px; x += 61) {
      const Eigen::Vector2d ray = kCameraModel.ray(Eigen::Vector2d(x, y));
      const Eigen::Vector2d pixel = kCameraModel.project({ray.x() * 333.0, ray.y() * 333.0, 333.0});
      EXPECT_NEAR((pixel - Eigen::Vector2d(x, y)).norm(), 0.0, 1e-9);
    }
  }
}

TEST(CameraModel, JacobianIsTheDerivativeOfDistort) {
  const Eigen::Vector2d at(0.21, -0.17);
  const double h = 1e-6;
  Eigen::Matrix2d numeric;
  for (int axis = 0; axis < 2; ++axis) {
    const Eigen::Vector2d step = h * Eigen::Vector2d::Unit(axis);
    numeric.col(axis) =
        (kCameraModel.distort(at + step) - kCameraModel.distort(at - step)) / (2.0 * h);
  }
  EXPECT_NEAR((numeric - kCameraModel.distort_jacobian(at)).norm(), 0.0, 1e-8);
}

TEST(CameraModel, HasNoRayWhereTheModelFoldsBack) {
  CameraModel folding = kCameraModel;
  folding.distortion = {-2.0, 0.0, 0.0, 0.0, 0.0};
  EXPECT_TRUE(folding.undistort({0.9, 0.0}).hasNaN());
}

TEST(CameraModel, RaysOfMatchesRayAtEveryPixel) {
  CameraModel folding = kCameraModel;  // so strong that the corners of the image have no ray
  folding.distortion[0] = -2.0;
  folding.focal_px = {700.0, 690.0};
  for (const CameraModel& model : {kCameraModel, folding}) {
    const auto rays = rays_of(model);
    int missing = 0;
    for (int y = 0; y < model.height_px; y += 3) {
      for (int x = 0; x < model.width_px; x += 3) {
        const Eigen::Vector2d ray = model.ray(Eigen::Vector2d(x, y));
        EXPECT_EQ(rays(x, y).hasNaN(), ray.hasNaN()) << x << ", " << y;
        if (ray.hasNaN()) ++missing;
        if (ray.hasNaN() || rays(x, y).hasNaN()) continue;
        EXPECT_LT((rays(x, y).cast<double>() - ray).norm(), 3e-7) << x << ", " << y;
      }
    }
    EXPECT_EQ(missing > 0, model.distortion[0] < -1.0);
  }
}

}  // namespace
}  // namespace frangia
