// The truth is a camera whose rays OpenCV undistorts.
#include "frangia/calibrate/solve/solve_camera.h"

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>

#include "support/error_of.h"

namespace frangia {
namespace {

constexpr int kWidth = 1280;
constexpr int kHeight = 1024;
const Screen kScreen{.width_px = 1920, .height_px = 1080, .pixel_mm = 0.25};

cv::Mat camera_matrix() {
  return (cv::Mat_<double>(3, 3) << 2400.0, 0.0, 646.8, 0.0, 2400.0, 507.4, 0.0, 0.0, 1.0);
}

/// What a camera pixel sees of the screen at a pose, or nothing beside it.
std::vector<LightSite> sites_at(const Eigen::Isometry3d& pose, double noise_px, unsigned seed) {
  const cv::Mat distortion = (cv::Mat_<double>(1, 5) << -0.09, 0.05, 4e-4, -3e-4, 0.0);
  std::vector<cv::Point2d> pixels;
  constexpr double kSlope = 0.5;  // px, of the derivative
  for (int y = 20; y < kHeight; y += 40) {
    for (int x = 20; x < kWidth; x += 40) {
      pixels.emplace_back(x, y);
      pixels.emplace_back(x + kSlope, y);
      pixels.emplace_back(x, y + kSlope);
    }
  }
  std::vector<cv::Point2d> rays;
  cv::undistortPoints(
      pixels,
      rays,
      camera_matrix(),
      distortion,
      cv::noArray(),
      cv::noArray(),
      cv::TermCriteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 100, 1e-14));
  const auto screen_px = [&](const cv::Point2d& ray) {
    const Eigen::Vector3d direction(ray.x, ray.y, 1.0);
    const Eigen::Vector3d normal = pose.linear().col(2);
    const Eigen::Vector3d point =
        direction * (normal.dot(pose.translation()) / normal.dot(direction));
    const Eigen::Vector3d place = pose.inverse() * point;
    return Eigen::Vector2d(place.x() / kScreen.pixel_mm + 959.5,
                           place.y() / kScreen.pixel_mm + 539.5);
  };
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0.0, noise_px);
  std::vector<LightSite> sites;
  for (std::size_t i = 0; i < pixels.size(); i += 3) {
    LightSite site;
    site.camera_px = {pixels[i].x, pixels[i].y};
    const Eigen::Vector2d here = screen_px(rays[i]);
    site.by_camera.col(0) = (screen_px(rays[i + 1]) - here) / kSlope;
    site.by_camera.col(1) = (screen_px(rays[i + 2]) - here) / kSlope;
    site.light = here + Eigen::Vector2d(normal(random), normal(random));
    site.sigma.setConstant(0.5 * noise_px);  // not the true noise
    if (here.minCoeff() > 0.0 && here.x() < 1919.0 && here.y() < 1079.0) sites.push_back(site);
  }
  return sites;
}

std::vector<ScreenView> screen_views(int count, double noise_px, double tilt = 0.4) {
  std::vector<ScreenView> views;
  for (int i = 0; i < count; ++i) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    const double direction = 2.4 * i;
    pose.linear() =
        Eigen::AngleAxisd(tilt, Eigen::Vector3d(std::cos(direction), std::sin(direction), 0.0))
            .toRotationMatrix();
    pose.translation() = Eigen::Vector3d(5.0 * i, -3.0 * i, 420.0 + 25.0 * i);
    views.push_back(
        {"pose " + std::to_string(i), sites_at(pose, noise_px, static_cast<unsigned>(i))});
  }
  return views;
}

std::string fault_of(const std::vector<ScreenView>& views, const Screen& screen = kScreen) {
  return testing::error_of(
      [&] { static_cast<void>(solve_camera(screen, views, kWidth, kHeight)); });
}

TEST(SolveCamera, FindsTheIntrinsicsWithinTheirUncertainty) {
  const CameraSolution found = solve_camera(kScreen, screen_views(8, 0.03), kWidth, kHeight);
  EXPECT_NEAR(found.camera.focal_px.x(), 2400.0, 0.2);
  EXPECT_NEAR(found.camera.principal_point_px.x(), 646.8, 0.2);
  EXPECT_NEAR(found.camera.principal_point_px.y(), 507.4, 0.2);
  EXPECT_NEAR(found.camera.distortion[0], -0.09, 2e-3);
  EXPECT_NEAR(found.camera.distortion[2], 4e-4, 5e-5);
  EXPECT_NEAR(found.camera.distortion[3], -3e-4, 5e-5);
  ASSERT_EQ(found.parameters.size(), 9U);
  EXPECT_EQ(found.parameters[0], "camera.focal_px");
  const auto sigma = [&](Eigen::Index i) { return std::sqrt(found.covariance(i, i)); };
  EXPECT_LT(std::abs(found.camera.focal_px.x() - 2400.0), 4.0 * sigma(0));
  EXPECT_LT(std::abs(found.camera.principal_point_px.x() - 646.8), 4.0 * sigma(2));
  EXPECT_LT(sigma(0), 0.2);
  // The residuals show that the stated standard deviations are half of the true ones.
  EXPECT_NEAR(found.residuals.sigma_px, 2.0, 0.2);
  EXPECT_LT(found.bend_mm, 0.01);
}

TEST(SolveCamera, NamesPosesThatAreParallel) {
  EXPECT_NE(fault_of(screen_views(5, 0.03, 0.0)).find("all poses of the screen are parallel"),
            std::string::npos);
}

TEST(SolveCamera, NamesTooFewPosesAndPoints) {
  EXPECT_NE(fault_of(screen_views(2, 0.03)).find("in 2 of at least 3 poses"), std::string::npos);
  std::vector<ScreenView> views = screen_views(4, 0.03);
  views[2].points.resize(20);
  EXPECT_NE(fault_of(views).find("pose 2: 20 points of the screen"), std::string::npos);
}

TEST(SolveCamera, NamesAMirroredScreen) {
  std::vector<ScreenView> views = screen_views(4, 0.03);
  for (LightSite& site : views[1].points)
    site.light.x() = 1919.0 - site.light.x();
  EXPECT_NE(fault_of(views).find("pose 1: the screen is seen mirrored"), std::string::npos)
      << fault_of(views);
}

TEST(SolveCamera, NamesAScreenWithoutSize) {
  EXPECT_NE(fault_of(screen_views(4, 0.03), {.width_px = 1920, .height_px = 1080}).find("pixel_mm"),
            std::string::npos);
}

}  // namespace
}  // namespace frangia
