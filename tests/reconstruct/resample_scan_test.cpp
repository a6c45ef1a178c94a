#include "frangia/reconstruct/internal/resample_scan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/missing.h"
#include "frangia/reconstruct/internal/splat_points.h"

#include "support/grid_of_points.h"

namespace frangia {
namespace {

/// The view of one scan, and its camera.
struct OneScan {
  std::vector<VirtualCamera> cameras;
  CameraModel model;
  ResampledScan resampled;

  explicit OneScan(const RangeScan& scan) : cameras{virtual_camera_of(scan)} {
    model = common_camera_model(cameras, scan.mesh.triangles.empty());
    resampled = resample_scan(scan, cameras.front(), model);
  }
  /// The points of the pixels, in the frame of the scan.
  [[nodiscard]] std::vector<Eigen::Vector3d> points() const {
    std::vector<Eigen::Vector3d> all;
    const auto rays = rays_of(model);
    const Image<float>& depth = resampled.view.range.depth_mm;
    for (int y = 0; y < depth.height(); ++y) {
      for (int x = 0; x < depth.width(); ++x) {
        if (std::isnan(depth(x, y))) continue;
        all.emplace_back(
            cameras.front().rig_from_scan.inverse() *
            (static_cast<double>(depth(x, y)) * rays(x, y).homogeneous().cast<double>()));
      }
    }
    return all;
  }
};

/// A ball as a grid of points that a scanner sees along z, joined to triangles.
RangeScan ball_scan(double radius_mm, double step_mm) {
  constexpr double kSteepest = 0.3;  // cosine of incidence
  const int half = static_cast<int>(radius_mm / step_mm);
  const int side = 2 * half + 1;
  std::vector<std::int64_t> number;
  RangeScan scan;
  for (int row = -half; row <= half; ++row) {
    for (int column = -half; column <= half; ++column) {
      const Eigen::Vector2d at(column * step_mm, row * step_mm);
      const double height = radius_mm * radius_mm - at.squaredNorm();
      const bool seen = height > std::pow(kSteepest * radius_mm, 2);
      number.push_back(seen ? static_cast<std::int64_t>(scan.mesh.vertices_mm.size()) : -1);
      if (seen)
        scan.mesh.vertices_mm.emplace_back(
            Eigen::Vector3d(at.x(), at.y(), std::sqrt(height)).cast<float>());
    }
  }
  const auto fits = [](const std::array<std::size_t, 3>&) { return true; };
  testing::join_grid(number, side, fits, scan.mesh);
  return scan;
}

TEST(ResampleScan, PutsDepthsOnTheCurvedSurfaceBetweenPoints) {
  constexpr double kRadius_mm = 20.0;
  const OneScan scan(ball_scan(kRadius_mm, 1.0));
  double sum = 0.0;
  double steep = 0.0;
  double steep_count = 0.0;
  const std::vector<Eigen::Vector3d> points = scan.points();
  ASSERT_GT(points.size(), 500U);
  for (const Eigen::Vector3d& point : points) {
    const double off_mm = point.norm() - kRadius_mm;
    sum += off_mm;
    if (point.z() > 0.5 * kRadius_mm) continue;
    steep += off_mm;
    steep_count += 1.0;
  }
  // The triangles lie inside of the ball by 0.01 mm, and by 0.03 mm where they are steep.
  EXPECT_NEAR(sum / static_cast<double>(points.size()), 0.0, 0.002);
  EXPECT_NEAR(steep / steep_count, 0.0, 0.006);
}

TEST(ResampleScan, PutsPointsWithoutTrianglesWhereTheirMeanIs) {
  constexpr double kNoise_mm = 0.05;
  constexpr double kSlope = 0.8;
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, kNoise_mm);
  RangeScan scan;
  for (int y = 0; y < 80; ++y) {
    for (int x = 0; x < 80; ++x) {
      scan.mesh.vertices_mm.emplace_back(
          Eigen::Vector3d(0.4 * x, 0.4 * y, 0.4 * kSlope * x + noise(random)).cast<float>());
    }
  }
  const OneScan resampled(scan);
  double sum = 0.0;
  double squares = 0.0;
  const std::vector<Eigen::Vector3d> points = resampled.points();
  ASSERT_GT(points.size(), 500U);
  for (const Eigen::Vector3d& point : points) {
    const double off_mm = point.z() - kSlope * point.x();
    sum += off_mm;
    squares += off_mm * off_mm;
  }
  const auto count = static_cast<double>(points.size());
  EXPECT_NEAR(sum / count, 0.0, 0.01);  // the nearest in each pixel: 0.16
  EXPECT_LT(std::sqrt(squares / count), kNoise_mm);
}

TEST(SplatPoints, LeavesOutWhatLiesBehindTheFrontSurface) {
  constexpr double kBehind_mm = 30.0;
  RangeScan scan;
  for (const double z : {0.0, -kBehind_mm})
    for (int i = 0; i < 60 * 60; ++i)
      scan.mesh.vertices_mm.emplace_back(
          Eigen::Vector3d(0.4 * (i % 60), 0.4 * (i / 60), z).cast<float>());
  const OneScan one(scan);
  const VirtualCamera& camera = one.cameras.front();
  Image<float> depth_mm(one.model.width_px, one.model.height_px, kMissing);
  Image<PixelColor> no_colors;
  splat_points(scan.mesh, camera, one.model, depth_mm, no_colors);
  const double front_mm = (camera.rig_from_scan * Eigen::Vector3d(12.0, 12.0, 0.0)).z();
  const auto near = std::count_if(depth_mm.pixels().begin(), depth_mm.pixels().end(), [&](float z) {
    return std::abs(static_cast<double>(z) - front_mm) < 0.1;
  });
  EXPECT_GT(near, 300);
}

}  // namespace
}  // namespace frangia
