#include "frangia/range/fuse_directions.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "frangia/core/missing.h"

#include "flat_view.h"

namespace frangia {
namespace {

/// A range grid of the wall at 500 mm with noise that varies over the columns.
RangeGrid noisy_wall(double least_mm, double slope_mm, unsigned seed, double offset_mm = 0.0) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> noise(0.0, 1.0);
  FlatView view;
  view.range.phase_rad = Image<float>(80, 60, 1.0F);
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 80; ++x) {
      const double sigma = least_mm + slope_mm * x;
      view.range.sigma_mm(x, y) = static_cast<float>(sigma);
      view.range.depth_mm(x, y) = static_cast<float>(500.0 + offset_mm + sigma * noise(generator));
    }
  }
  return view.range;
}

double rms_of_column(const RangeGrid& range, int x) {
  double square = 0.0;
  for (int y = 0; y < 60; ++y)
    square += std::pow(range.depth_mm(x, y) - 500.0, 2) / 60.0;
  return std::sqrt(square);
}

TEST(FuseDirections, LeastSquaresReachesTheNoiseOfBothWeightedByTheirVariances) {
  const FlatView view;
  RangeGrid fused = noisy_wall(0.02, 0.002, 1);
  const RangeGrid second = noisy_wall(0.18, -0.002, 2);
  const RangeGrid first = fused;
  Image<PixelStatus> status = view.status;
  const auto found = fuse_directions(second, view.rays, {}, fused, status);
  EXPECT_EQ(found.pixels, 4800U);
  EXPECT_EQ(found.removed, 0U);
  EXPECT_NEAR(found.median_over_sigma, 0.6745, 0.03);
  double over_sigma = 0.0;
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 80; ++x) {
      const double expected =
          1.0 / std::hypot(1.0 / first.sigma_mm(x, y), 1.0 / second.sigma_mm(x, y));
      EXPECT_NEAR(fused.sigma_mm(x, y), expected, 1e-6);
      over_sigma += std::pow((fused.depth_mm(x, y) - 500.0) / expected, 2) / 4800.0;
    }
  }
  EXPECT_NEAR(over_sigma, 1.0, 0.06);
  double fused_square = 0.0;
  double better_square = 0.0;
  for (int x = 0; x < 80; ++x) {
    fused_square += std::pow(rms_of_column(fused, x), 2);
    better_square += std::pow(std::min(rms_of_column(first, x), rms_of_column(second, x)), 2);
  }
  EXPECT_LT(fused_square, better_square);
}

TEST(FuseDirections, CountsADisagreementWholeUnlessTheCalibrationExplainsIt) {
  constexpr double kApart_mm = 0.3;
  const FlatView view;
  const RangeGrid second = noisy_wall(0.02, 0.0, 2, kApart_mm);
  const auto fuse = [&](const FuseDirectionsOptions& options, RangeGrid& fused) {
    fused = noisy_wall(0.02, 0.0, 1);
    Image<PixelStatus> status = view.status;
    return fuse_directions(second, view.rays, options, fused, status);
  };
  RangeGrid fused;
  const auto unknown = fuse({}, fused);
  EXPECT_GT(unknown.chi_squared, 50.0);
  EXPECT_GT(unknown.beyond, 0.95);
  ASSERT_FALSE(fused.systematic_mm.empty());
  EXPECT_NEAR(fused.systematic_mm(40, 30), kApart_mm, 0.1 * kApart_mm);
  const auto known = fuse({.calibration = [&](const auto&) { return kApart_mm; }}, fused);
  EXPECT_TRUE(known.by_calibration);
  EXPECT_LT(known.chi_squared, kConsistent);
  EXPECT_EQ(known.beyond, 0.0);
  EXPECT_TRUE(fused.systematic_mm.empty());
}

TEST(FuseDirections, CountsADisagreementWhereOneDirectionAloneMeasured) {
  constexpr double kApart_mm = 0.3;
  const FlatView view;
  for (const auto fusion : {DirectionFusion::LeastSquares, DirectionFusion::Best}) {
    RangeGrid fused = noisy_wall(0.02, 0.0, 1);
    RangeGrid second = noisy_wall(0.019, 0.0, 2, kApart_mm);
    for (int y = 0; y < 60; ++y) {
      for (int x = 0; x < 20; ++x) {
        fused.remove(x, y);
        second.remove(79 - x, y);
      }
    }
    Image<PixelStatus> status = view.status;
    static_cast<void>(fuse_directions(second, view.rays, {.fusion = fusion}, fused, status));
    ASSERT_FALSE(fused.systematic_mm.empty());
    for (int y = 0; y < 60; ++y) {
      for (int x = 0; x < 80; ++x)
        EXPECT_NEAR(fused.systematic_mm(x, y), kApart_mm, 0.15 * kApart_mm) << x << " " << y;
    }
  }
}

TEST(FuseDirections, CountsNothingForSoundDirectionsWhoseNoiseIsStatedTooSmall) {
  const FlatView view;
  RangeGrid fused = noisy_wall(0.02, 0.0, 1);
  RangeGrid second = noisy_wall(0.02, 0.0, 2);
  for (RangeGrid* range : {&fused, &second}) {
    for (float& sigma : range->sigma_mm.pixels())
      sigma *= 0.8F;
  }
  Image<PixelStatus> status = view.status;
  const auto found = fuse_directions(second, view.rays, {}, fused, status);
  EXPECT_LT(found.chi_squared, kConsistent);
  EXPECT_LT(found.beyond, 0.001);
  EXPECT_TRUE(fused.systematic_mm.empty());
}

TEST(FuseDirections, BestTakesTheSmallerSigma) {
  const FlatView view;
  RangeGrid fused = noisy_wall(0.02, 0.002, 1);
  const RangeGrid first = fused;
  const RangeGrid second = noisy_wall(0.18, -0.002, 2);
  Image<PixelStatus> status = view.status;
  static_cast<void>(
      fuse_directions(second, view.rays, {.fusion = DirectionFusion::Best}, fused, status));
  EXPECT_EQ(fused.depth_mm(5, 9), first.depth_mm(5, 9));
  EXPECT_EQ(fused.depth_mm(75, 9), second.depth_mm(75, 9));
}

TEST(FuseDirections, KeepsPointsThatOnlyOneDirectionMeasured) {
  const FlatView view;
  RangeGrid fused = noisy_wall(0.02, 0.0, 1);
  RangeGrid second = noisy_wall(0.02, 0.0, 2);
  Image<PixelStatus> status = view.status;
  fused.remove(3, 4);
  status(3, 4) = PixelStatus::UncertainOrder;
  second.remove(6, 7);
  const float only = fused.depth_mm(6, 7);
  static_cast<void>(fuse_directions(second, view.rays, {}, fused, status));
  EXPECT_EQ(fused.depth_mm(3, 4), second.depth_mm(3, 4));
  EXPECT_TRUE(std::isnan(fused.phase_rad(3, 4)));
  EXPECT_EQ(status(3, 4), PixelStatus::Measured);
  EXPECT_EQ(fused.depth_mm(6, 7), only);
}

TEST(FuseDirections, RemovesPointsWithAWrongOrderAndReportsTheErrorOfTheRig) {
  const FlatView view;
  RangeGrid fused = noisy_wall(0.02, 0.0, 1);
  const RangeGrid second = noisy_wall(0.02, 0.0, 2, 0.3);
  Image<PixelStatus> status = view.status;
  fused.depth_mm(3, 4) += 12.0F;
  const auto found = fuse_directions(second, view.rays, {}, fused, status);
  EXPECT_NEAR(found.median_mm, 0.3, 0.01);
  EXPECT_GT(found.median_over_sigma, 8.0);
  EXPECT_EQ(found.removed, 1U);
  EXPECT_TRUE(std::isnan(fused.depth_mm(3, 4)));
  EXPECT_EQ(status(3, 4), PixelStatus::UncertainOrder);
}

}  // namespace
}  // namespace frangia
