#include "frangia/range/laser_profile.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "frangia/core/error.h"
#include "frangia/rig/paper_rig.h"

namespace frangia {
namespace {

/// A wall across the view with stray light and a laser line on it.
struct WallWithStrayLight {
  Rig rig = make_paper_rig({.focal_mm = 25.0, .columns = 320, .rows = 120});
  double z_mm = 505.0;
  double spill = 0.05;
  double ambient = 0.0;
  double noise_counts = 0.7;
  Image<float> lit{320, 120, 100.0F};

  /// The column of the laser sheet in row y: normal . (x z, y z, z) = offset.
  [[nodiscard]] double true_column(double /*row*/) const {
    const LaserSheet& plane = *rig.laser_sheet;
    const double x = (plane.offset_mm / z_mm - plane.normal.z()) / plane.normal.x();
    return rig.camera.model.focal_px.x() * x + rig.camera.model.principal_point_px.x();
  }
  [[nodiscard]] FrameStack photograph() const {
    std::mt19937 generator(2);
    std::normal_distribution<double> noise(0.0, noise_counts);
    Image<std::uint8_t> image(lit.width(), lit.height());
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width(); ++x) {
        const double across = (x - true_column(y)) / 1.6;
        const double line = lit(x, y) * (1.5 * std::exp(-0.5 * across * across) + spill);
        const double other = lit(x, y) > 0.0F ? ambient : 0.0;
        image(x, y) = static_cast<std::uint8_t>(
            std::lround(std::clamp(line + other + noise(generator), 0.0, 255.0)));
      }
    }
    return {.pattern = {.name = "line", .kind = PatternKind::Line},
            .frames = {Frame(std::move(image))},
            .white_level = 255};
  }
  [[nodiscard]] std::vector<ProfilePoint> profile() const {
    return laser_profile(photograph(), lit, rig, {.floor_counts2 = noise_counts * noise_counts});
  }
};

TEST(LaserProfile, FindsTheLineInEveryRowToATenthOfAPixel) {
  const WallWithStrayLight wall;
  const auto profile = wall.profile();
  ASSERT_EQ(profile.size(), 120U);
  double square = 0.0;
  double predicted = 0.0;
  for (const ProfilePoint& point : profile) {
    const double error = point.pixel.x() - wall.true_column(point.pixel.y());
    EXPECT_NEAR(error, 0.0, 0.1);
    square += error * error;
    predicted += point.sigma_px * point.sigma_px;
    EXPECT_NEAR(point.point_mm.z(), wall.z_mm, 0.5);
  }
  EXPECT_LT(std::sqrt(square / predicted), 2.0);
}

/// A dim narrow post away from the laser sheet, and a wall whose brightness rises across the view.
WallWithStrayLight post_and_wall(double ambient) {
  WallWithStrayLight wall;
  wall.spill = 0.08;
  wall.ambient = ambient;
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 320; ++x) {
      if (x < 40 || x > 52) wall.lit(x, y) = 0.0F;
      if (x > 120 && x < 260) wall.lit(x, y) = static_cast<float>(20 + (x - 120));
    }
  }
  return wall;
}

TEST(LaserProfile, IgnoresEdgesOfAPartInStrayLight) {
  const WallWithStrayLight wall = post_and_wall(0.0);
  for (const ProfilePoint& point : wall.profile())
    EXPECT_NEAR(point.pixel.x(), wall.true_column(point.pixel.y()), 0.5);
}

TEST(LaserProfile, IgnoresAmbientLight) {
  const WallWithStrayLight wall = post_and_wall(12.0);
  for (const ProfilePoint& point : wall.profile())
    EXPECT_NEAR(point.pixel.x(), wall.true_column(point.pixel.y()), 0.5);
}

TEST(LaserProfile, IsEmptyWithoutALine) {
  const WallWithStrayLight dark;
  FrameStack frame = dark.photograph();
  for (auto& counts : std::get<Image<std::uint8_t>>(frame.frames[0]).pixels())
    counts = 5;
  EXPECT_TRUE(laser_profile(frame, dark.lit, dark.rig, {}).empty());
}

TEST(LaserProfile, RefusesARigWithoutALaserSheet) {
  WallWithStrayLight wall;
  const FrameStack frame = wall.photograph();
  wall.rig.laser_sheet.reset();
  EXPECT_THROW(static_cast<void>(laser_profile(frame, wall.lit, wall.rig, {})), Error);
}

}  // namespace
}  // namespace frangia
