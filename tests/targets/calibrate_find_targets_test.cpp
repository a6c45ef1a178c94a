#include "frangia/targets/calibrate_find_targets.h"

#include <cmath>
#include <cstdint>
#include <functional>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "frangia/core/error.h"
#include "frangia/core/random.h"

namespace frangia {
namespace {

/// A plane that is seen obliquely; its points along `side` and `other` from `origin_mm`.
struct SeenPlane {
  Eigen::Vector3d origin_mm{4.0, -3.0, 400.0};
  Eigen::Vector3d normal = Eigen::Vector3d(0.62, -0.3, -0.72).normalized();
  Eigen::Vector3d side = normal.cross(Eigen::Vector3d::UnitY()).normalized();
  Eigen::Vector3d other = side.cross(normal);  // downwards, as the camera sees it

  [[nodiscard]] Eigen::Vector3d at(double x, double y) const {
    return origin_mm + x * side + y * other;
  }
};

CameraModel camera_of_test() {
  CameraModel camera;
  camera.width_px = 260;
  camera.height_px = 200;
  camera.focal_px = {1200.0, 1200.0};
  camera.principal_point_px = {129.3, 101.6};
  camera.distortion[0] = -0.12;
  return camera;
}

using Albedo = std::function<double(double x_mm, double y_mm)>;

/// Rays traced to the plane, by a lens whose blur is a sum over neighbouring directions.
Image<float> image_of(const SeenPlane& plane,
                      const CameraModel& camera,
                      const Albedo& albedo,
                      double blur_px,
                      double noise_counts = 0.0,
                      std::uint64_t seed = 1) {
  constexpr int kSamples = 6;
  const auto sample = [&](double u, double v) {
    const Eigen::Vector2d ray = camera.ray({u, v});
    const Eigen::Vector3d direction(ray.x(), ray.y(), 1.0);
    const Eigen::Vector3d point =
        direction * (plane.normal.dot(plane.origin_mm) / plane.normal.dot(direction));
    const Eigen::Vector3d away = point - plane.origin_mm;
    // Light that falls off to one side.
    return albedo(away.dot(plane.side), away.dot(plane.other)) *
           (1.0 + 0.006 * away.dot(plane.side));
  };
  Image<float> sharp(camera.width_px, camera.height_px);
  for (int y = 0; y < sharp.height(); ++y) {
    for (int x = 0; x < sharp.width(); ++x) {
      double sum = 0.0;
      for (int j = 0; j < kSamples; ++j)
        for (int i = 0; i < kSamples; ++i)
          sum += sample(x + (i + 0.5) / kSamples - 0.5, y + (j + 0.5) / kSamples - 0.5);
      sharp(x, y) = static_cast<float>(1000.0 * sum / (kSamples * kSamples));
    }
  }
  Image<float> image(camera.width_px, camera.height_px);
  constexpr int kReach = 5;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      double sum = 0.0;
      double weights = 0.0;
      for (int j = -kReach; j <= kReach; ++j) {
        for (int i = -kReach; i <= kReach; ++i) {
          const int u = x + i;
          const int v = y + j;
          if (u < 0 || v < 0 || u >= image.width() || v >= image.height()) continue;
          const double weight = blur_px > 0.0
                                    ? std::exp(-0.5 * (i * i + j * j) / (blur_px * blur_px))
                                    : (i == 0 && j == 0 ? 1.0 : 0.0);
          sum += weight * static_cast<double>(sharp(u, v));
          weights += weight;
        }
      }
      const auto index = static_cast<std::uint64_t>(y * image.width() + x);
      image(x, y) =
          static_cast<float>(sum / weights + noise_counts * normal_from(hash(hash(seed), index)));
    }
  }
  return image;
}

RangeGrid range_of(const SeenPlane& plane, const CameraModel& camera, double sigma_mm) {
  RangeGrid range{Image<float>(camera.width_px, camera.height_px),
                  Image<float>(camera.width_px, camera.height_px, static_cast<float>(sigma_mm))};
  const Image<Eigen::Vector2f> rays = rays_of(camera);
  for (int y = 0; y < camera.height_px; ++y) {
    for (int x = 0; x < camera.width_px; ++x) {
      const Eigen::Vector3d direction = rays(x, y).cast<double>().homogeneous();
      const double depth = plane.normal.dot(plane.origin_mm) / plane.normal.dot(direction);
      const auto index = static_cast<std::uint64_t>(y * camera.width_px + x);
      range.depth_mm(x, y) =
          static_cast<float>(depth + sigma_mm * normal_from(hash(hash(77), index)));
    }
  }
  return range;
}

double disc(double x, double y, double cx, double cy, double diameter, double in, double out) {
  return std::hypot(x - cx, y - cy) < 0.5 * diameter ? in : out;
}

class BlurredDisc : public ::testing::TestWithParam<double> {};

TEST_P(BlurredDisc, HasItsCenterWhereTheCircleIsAndNotItsImage) {
  const SeenPlane plane;
  const CameraModel camera = camera_of_test();
  const TargetSet targets{.diameter_mm = 24.0};  // large: its image's centre is 0.5 px elsewhere
  const Image<float> image = image_of(
      plane,
      camera,
      [](double x, double y) { return disc(x, y, 1.3, -0.8, 24.0, 0.1, 0.8); },
      GetParam());
  const auto found = find_targets(image, range_of(plane, camera, 0.001), camera, targets);
  ASSERT_EQ(found.size(), 1U);
  const Eigen::Vector3d truth = plane.at(1.3, -0.8);
  const double pixel_mm = truth.z() / camera.focal_px.x();
  EXPECT_LT((found[0].center_mm - truth).norm(), 0.02 * pixel_mm);
  EXPECT_LT((found[0].center_px - camera.project(truth)).norm(), 0.02);
  EXPECT_NEAR(found[0].size_ratio, 1.0, 0.005);
  EXPECT_GT(found[0].normal.dot(plane.normal), 0.9999);
  // The uncorrected centre of the outline: the mean of its projected points' extremes.
  Eigen::AlignedBox2d box;
  for (int i = 0; i < 360; ++i) {
    const double angle = i * std::acos(-1.0) / 180.0;
    box.extend(
        camera.project(plane.at(1.3 + 12.0 * std::cos(angle), -0.8 + 12.0 * std::sin(angle))));
  }
  EXPECT_GT((box.center() - camera.project(truth)).norm(), 0.15);
}

INSTANTIATE_TEST_SUITE_P(Blurs, BlurredDisc, ::testing::Values(0.0, 0.7, 1.3));

TEST(FindTargets, FindsLightDiscsOnDarkOnly) {
  const SeenPlane plane;
  const CameraModel camera = camera_of_test();
  const auto albedo = [](double x, double y) {
    if (std::hypot(x - 12.0, y) < 4.0) return 0.9;
    if (std::hypot(x + 12.0, y) < 4.0) return 0.05;
    return 0.3;
  };
  const Image<float> image = image_of(plane, camera, albedo, 0.6);
  const RangeGrid range = range_of(plane, camera, 0.002);
  const auto light =
      find_targets(image, range, camera, {.diameter_mm = 8.0, .tone = TargetTone::Light});
  ASSERT_EQ(light.size(), 1U);
  EXPECT_LT((light[0].center_mm - plane.at(12.0, 0.0)).norm(), 0.02);
  const auto dark = find_targets(image, range, camera, {.diameter_mm = 8.0});
  ASSERT_EQ(dark.size(), 1U);
  EXPECT_LT((dark[0].center_mm - plane.at(-12.0, 0.0)).norm(), 0.02);
}

TEST(FindTargets, LeavesOutDiscsOfAnotherSize) {
  const SeenPlane plane;
  const CameraModel camera = camera_of_test();
  const auto albedo = [](double x, double y) { return disc(x, y, 0.0, 0.0, 8.0, 0.1, 0.8); };
  const Image<float> image = image_of(plane, camera, albedo, 0.6);
  EXPECT_TRUE(
      find_targets(image, range_of(plane, camera, 0.002), camera, {.diameter_mm = 6.0}).empty());
}

TEST(FindTargets, ReadsCodedTargetsAndTheirCenters) {
  const SeenPlane plane;
  const CameraModel camera = camera_of_test();
  const TargetSet targets{.dictionary = "DICT_4X4_50", .marker_mm = 14.0};
  const auto albedo = [&](double x, double y) {
    const bool left = x < 0.0;
    const double turn = left ? 0.4 : -1.1;
    const double u = x - (left ? -13.0 : 13.0);
    return is_target_dark(targets,
                          left ? 7 : 21,
                          std::cos(turn) * u + std::sin(turn) * y,
                          std::cos(turn) * y - std::sin(turn) * u)
               ? 0.08
               : 0.85;
  };
  const auto found = find_targets(
      image_of(plane, camera, albedo, 0.7), range_of(plane, camera, 0.002), camera, targets);
  ASSERT_EQ(found.size(), 2U);
  for (const TargetSighting& one : found) {
    ASSERT_TRUE(one.code == 7 || one.code == 21) << one.code;
    const Eigen::Vector3d truth = plane.at(one.code == 7 ? -13.0 : 13.0, 0.0);
    EXPECT_LT((one.center_mm - truth).norm(), 0.01);
  }
}

TEST(FindTargets, StatesASigmaThatHoldsTheErrors) {
  const SeenPlane plane;
  const CameraModel camera = camera_of_test();
  const TargetSet targets{.diameter_mm = 6.0};
  const auto albedo = [](double x, double y) { return disc(x, y, 2.0, 1.0, 6.0, 0.1, 0.8); };
  double chi_squared = 0.0;
  constexpr int kSeeds = 12;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const Image<float> image =
        image_of(plane, camera, albedo, 0.8, 40.0, static_cast<std::uint64_t>(seed));
    const auto found = find_targets(image, range_of(plane, camera, 0.001), camera, targets);
    ASSERT_EQ(found.size(), 1U);
    const Eigen::Vector3d away = found[0].center_mm - plane.at(2.0, 1.0);
    chi_squared += away.dot(found[0].covariance_mm2.inverse() * away);
  }
  // The plane is the same each time, so two of three coordinates are drawn.
  EXPECT_GT(chi_squared / (2 * kSeeds), 0.4);
  EXPECT_LT(chi_squared / (2 * kSeeds), 2.0);
}

TEST(FindTargets, RefusesAnImageOfAnotherSize) {
  const CameraModel camera = camera_of_test();
  const SeenPlane plane;
  EXPECT_THROW(static_cast<void>(find_targets(
                   Image<float>(10, 10), range_of(plane, camera, 0.1), camera, {.diameter_mm = 4})),
               Error);
}

}  // namespace
}  // namespace frangia
