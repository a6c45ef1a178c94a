#include "frangia/reconstruct/check_silhouettes.h"

#include <cmath>

#include <gtest/gtest.h>

#include "frangia/core/error.h"
#include "frangia/core/random.h"
#include "frangia/geometry/transform_mesh.h"

#include "support/test_meshes.h"

namespace frangia {
namespace {

constexpr double kRadius_mm = 20.0;

CameraModel silhouette_camera() {
  CameraModel camera;
  camera.width_px = 200;
  camera.height_px = 160;
  camera.focal_px = {1000.0, 1000.0};
  camera.principal_point_px = {99.4, 80.7};
  return camera;
}

/// Where a ball of the object's origin is seen, from two sides.
Eigen::Isometry3d view_pose(double angle_rad) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::AngleAxisd(angle_rad, Eigen::Vector3d::UnitY()).toRotationMatrix();
  pose.translation() = Eigen::Vector3d(1.0, -2.0, 400.0);
  return pose;
}

/// A dark ball before a wall of light: rays against the sphere, 25 a pixel, noise of the camera.
BacklitView ball_before_light(double angle_rad, double lit_counts) {
  const CameraModel camera = silhouette_camera();
  BacklitView view{Image<float>(200, 160), Image<float>(200, 160), view_pose(angle_rad)};
  const Eigen::Vector3d center = view.rig_from_object.translation();
  const auto hits = [&](double u, double v) {
    const Eigen::Vector3d direction = camera.ray({u, v}).homogeneous().normalized();
    return direction.cross(center).norm() < kRadius_mm;
  };
  constexpr int kSamples = 5;
  for (int y = 0; y < 160; ++y) {
    for (int x = 0; x < 200; ++x) {
      double share = 0.0;
      for (int i = 0; i < kSamples * kSamples; ++i) {
        share += hits(x + (i % kSamples + 0.5) / kSamples - 0.5,
                      y + (i / kSamples + 0.5) / kSamples - 0.5)
                     ? 1.0 / (kSamples * kSamples)
                     : 0.0;
      }
      const auto noise = normal_from(hash(hash(5), static_cast<std::uint64_t>(200 * y + x)));
      view.counts(x, y) =
          static_cast<float>(share * 100.0 + (1.0 - share) * lit_counts + 5.0 * noise);
      view.depth_mm(x, y) = share > 0.99 ? 400.0F : kMissing;
    }
  }
  return view;
}

SilhouetteReport check_ball(double radius_mm, double lit_counts = 2000.0) {
  const std::vector<BacklitView> views = {ball_before_light(0.0, lit_counts),
                                          ball_before_light(1.2, lit_counts)};
  const RayScene surface(testing::sphere(Eigen::Vector3d::Zero(), radius_mm, 180));
  return check_silhouettes(
      surface, views.size(), [&](std::size_t i) { return views[i]; }, silhouette_camera());
}

TEST(CheckSilhouettes, FindsTheRimsOfATrueSurfaceAtTheEdges) {
  const SilhouetteReport report = check_ball(kRadius_mm);
  EXPECT_EQ(report.views, 2U);
  EXPECT_GT(report.rims, 300U);
  EXPECT_FALSE(report.contradicts()) << report.text();
  EXPECT_NEAR(report.outside_mm, 0.0, 0.04);  // a pixel has 0.4 mm
  EXPECT_NEAR(report.limit_mm, 0.2, 0.01);
}

TEST(CheckSilhouettes, ContradictsASurfaceThatIsTooFarOutByWhatItIs) {
  const SilhouetteReport report = check_ball(kRadius_mm + 0.5);
  EXPECT_TRUE(report.contradicts());
  EXPECT_NEAR(report.outside_mm, 0.5, 0.05);
  EXPECT_NE(report.text().find("reaches beyond the silhouettes"), std::string::npos);
}

TEST(CheckSilhouettes, StatesWhatASurfaceWithinThemExcludes) {
  const SilhouetteReport report = check_ball(kRadius_mm - 0.5);
  EXPECT_FALSE(report.contradicts());
  EXPECT_NEAR(report.outside_mm, -0.5, 0.05);
  EXPECT_NEAR(report.excluded_mm, 0.7, 0.06);
}

TEST(CheckSilhouettes, SaysNothingWithoutALitBackground) {
  const SilhouetteReport report = check_ball(kRadius_mm, 180.0);
  EXPECT_EQ(report.views, 0U);
  EXPECT_TRUE(std::isnan(report.outside_mm));
  EXPECT_TRUE(report.text().empty());
}

TEST(CheckSilhouettes, RefusesViewsOfAnotherSize) {
  const auto small = [](std::size_t) {
    return BacklitView{Image<float>(4, 4), Image<float>(4, 4)};
  };
  const RayScene surface(testing::sphere(Eigen::Vector3d::Zero(), 1.0));
  EXPECT_THROW(static_cast<void>(check_silhouettes(surface, 1, small, silhouette_camera())), Error);
}

}  // namespace
}  // namespace frangia
