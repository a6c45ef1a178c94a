#include "frangia/range/laser_profile.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

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
    return rig.reference().model.focal_px.x() * x + rig.reference().model.principal_point_px.x();
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

/// The columns at which a row of counts is found to hold a line, on a part of even brightness.
std::vector<ProfilePoint> points_of_row(const std::vector<int>& row,
                                        const NoiseModel& noise = {.floor_counts2 = 0.5},
                                        const LaserProfileOptions& options = {}) {
  Image<std::uint8_t> image(static_cast<int>(row.size()), 1);
  for (int x = 0; x < image.width(); ++x)
    image(x, 0) = static_cast<std::uint8_t>(row[static_cast<std::size_t>(x)]);
  const Image<float> lit(image.width(), 1, 100.0F);
  return laser_profile({.pattern = {.name = "line", .kind = PatternKind::Line},
                        .frames = {Frame(std::move(image))},
                        .white_level = 255},
                       lit,
                       make_paper_rig({.columns = 320, .rows = 120}),
                       noise,
                       options);
}

std::vector<int> dark_row_with(const std::vector<int>& line, int before = 30) {
  std::vector<int> row(80, 0);
  std::copy(line.begin(), line.end(), row.begin() + before);
  return row;
}

TEST(LaserProfile, IsTheCenterOfGravityAboveAFifthOfTheHeight) {
  // A skew line of height 100 on a glow of 10: of it counts what is above 30.
  const std::vector<int> line = {10, 10, 10, 25, 60, 110, 80, 45, 32, 28, 10, 10, 10};
  double weight = 0.0;
  double moment = 0.0;
  for (std::size_t i = 4; i <= 8; ++i) {
    weight += line[i] - 30;
    moment += (line[i] - 30) * (30.0 + static_cast<double>(i));
  }
  const double center = moment / weight;
  double variance = 0.0;
  for (std::size_t i = 4; i <= 8; ++i)
    variance +=
        std::pow((30.0 + static_cast<double>(i) - center) / weight, 2) * (0.5 + 0.2 * line[i]);
  const auto found = points_of_row(
      dark_row_with(line), {.floor_counts2 = 0.5, .slope_counts = 0.2}, {.half_width_px = 5});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].pixel.x(), center, 1e-9);
  EXPECT_EQ(found[0].pixel.y(), 0.0);
  EXPECT_NEAR(found[0].sigma_px, std::sqrt(variance), 1e-9);
}

TEST(LaserProfile, NeedsAHeightOfSixSigmaAndTwoCounts) {
  const NoiseModel noise{.floor_counts2 = 4.0};  // 6 * 2 + 2 = 14 counts
  EXPECT_EQ(points_of_row(dark_row_with({7, 15, 7}), noise).size(), 1U);
  EXPECT_TRUE(points_of_row(dark_row_with({7, 13, 7}), noise).empty());
}

TEST(LaserProfile, TakesNoHotPixelForALine) {
  EXPECT_TRUE(points_of_row(dark_row_with({9, 100, 9})).empty());
  EXPECT_EQ(points_of_row(dark_row_with({11, 100, 0})).size(), 1U);
  EXPECT_EQ(points_of_row(dark_row_with({0, 100, 11})).size(), 1U);
}

TEST(LaserProfile, LeavesOutALineWithMoreThanThreeSaturatedPixels) {
  EXPECT_EQ(points_of_row(dark_row_with({100, 255, 255, 255, 100})).size(), 1U);
  EXPECT_TRUE(points_of_row(dark_row_with({100, 255, 255, 255, 255, 100})).empty());
}

TEST(LaserProfile, FindsEachOfTwoLinesThatAreFurtherApartThanHalfTheWidth) {
  std::vector<int> row = dark_row_with({50, 100, 50}, 20);
  row[40] = row[42] = 30;
  row[41] = 60;
  const auto apart = points_of_row(row);
  ASSERT_EQ(apart.size(), 2U);
  EXPECT_NEAR(apart[0].pixel.x(), 21.0, 1e-9);
  EXPECT_NEAR(apart[1].pixel.x(), 41.0, 1e-9);
  EXPECT_EQ(points_of_row(row, {.floor_counts2 = 0.5}, {.half_width_px = 30}).size(), 1U);
}

TEST(LaserProfile, FindsALineThatRunsAcrossTheImageInEachColumn) {
  WallWithStrayLight wall;
  wall.rig.laser_sheet->normal = Eigen::Vector3d(0.05, 1.0, 0.1).normalized();
  wall.rig.laser_sheet->offset_mm = wall.rig.laser_sheet->normal.z() * wall.z_mm;
  const CameraModel& camera = wall.rig.reference().model;
  const auto row_of = [&](double x) {  // normal . (x, y, 0) = 0 at the depth of the wall
    return camera.principal_point_px.y() -
           0.05 * (x - camera.principal_point_px.x()) * camera.focal_px.y() / camera.focal_px.x();
  };
  Image<std::uint8_t> image(wall.lit.width(), wall.lit.height());
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const double across = (y - row_of(x)) / 1.6;
      image(x, y) =
          static_cast<std::uint8_t>(std::lround(150.0 * std::exp(-0.5 * across * across)));
    }
  }
  const auto profile = laser_profile({.pattern = {.name = "line", .kind = PatternKind::Line},
                                      .frames = {Frame(std::move(image))},
                                      .white_level = 255},
                                     wall.lit,
                                     wall.rig,
                                     {.floor_counts2 = 0.5});
  ASSERT_EQ(profile.size(), 320U);
  for (std::size_t column = 0; column < profile.size(); ++column) {
    EXPECT_EQ(profile[column].pixel.x(), static_cast<double>(column));
    EXPECT_NEAR(profile[column].pixel.y(), row_of(static_cast<double>(column)), 0.05);
    EXPECT_NEAR(profile[column].point_mm.z(), wall.z_mm, 1.0);
  }
}

TEST(LaserProfile, SubtractsStrayLightInProportionToTheBrightness) {
  // Ambient light of 20 counts and spill of a tenth, on a part that brightens to the right.
  Image<std::uint8_t> image(320, 64);
  Image<float> lit(320, 64);
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      lit(x, y) = 20.0F + 0.5F * static_cast<float>(x);
      const double across = (x - 160.0) / 1.6;
      image(x, y) = static_cast<std::uint8_t>(std::lround(
          20.0 + 0.1 * static_cast<double>(lit(x, y)) + 60.0 * std::exp(-0.5 * across * across)));
    }
  }
  const FrameStack frame{.pattern = {.name = "line", .kind = PatternKind::Line},
                         .frames = {Frame(image)},
                         .white_level = 255};
  const Rig rig = make_paper_rig({.columns = 320, .rows = 64});
  // The least height is a share of the stray light where the part begins: 10 sigma of 0.5 counts.
  const double stray = 20.0 + 0.1 * 5.0;
  const auto points = [&](double contrast) {
    return laser_profile(frame, lit, rig, {.floor_counts2 = 0.25}, {.min_contrast = contrast})
        .size();
  };
  EXPECT_EQ(points(57.0 / stray), 64U);
  EXPECT_EQ(points(63.0 / stray), 0U);
}

TEST(LaserProfile, RefusesARigWithoutALaserSheet) {
  WallWithStrayLight wall;
  const FrameStack frame = wall.photograph();
  wall.rig.laser_sheet.reset();
  EXPECT_THROW(static_cast<void>(laser_profile(frame, wall.lit, wall.rig, {})), Error);
}

}  // namespace
}  // namespace frangia
