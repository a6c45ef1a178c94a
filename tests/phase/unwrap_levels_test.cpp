#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/phase/temporal/unwrap_temporally.h"

namespace frangia {
namespace {

constexpr double kFieldColumns = 640.0;

Projector field_of_columns() {
  Projector projector;
  projector.model = CameraModel{
      .width_px = static_cast<int>(kFieldColumns), .height_px = 480, .focal_px = {800.0, 800.0}};
  return projector;
}

std::vector<Pattern> patterns_with(const std::vector<double>& fringes) {
  std::vector<Pattern> patterns;
  for (const double count : fringes)
    patterns.push_back({.name = "p", .period_px = kFieldColumns / count});
  return patterns;
}

/// Fringes over the field of each level.
std::vector<double> levels_of(const std::vector<double>& fringes, double sigma_rad = 0.05) {
  const auto levels = find_unwrap_levels(patterns_with(fringes), field_of_columns(), sigma_rad);
  std::vector<double> out;
  for (const UnwrapLevel& level : levels)
    out.push_back(std::round(level.per_unit * kFieldColumns * 1e6) / 1e6);
  return out;
}

using Counts = std::vector<double>;

TEST(FindUnwrapLevels, GoesThroughTheMapsFromOneFringe) {
  EXPECT_EQ(levels_of({1, 8, 64}), (Counts{1, 8, 64}));
  EXPECT_EQ(levels_of({1}), (Counts{1}));
}

TEST(FindUnwrapLevels, BeginsWithABeatOfOneFringe) {
  const auto levels = find_unwrap_levels(patterns_with({63, 64}), field_of_columns(), 0.001);
  ASSERT_EQ(levels.size(), 2U);
  EXPECT_EQ(levels[0].map, 1U);
  EXPECT_EQ(levels[0].subtracted, 0);
  EXPECT_NEAR(levels[0].per_unit * kFieldColumns, 1.0, 1e-9);
  EXPECT_EQ(levels[1].map, 1U);
  EXPECT_EQ(levels[1].subtracted, -1);
}

TEST(FindUnwrapLevels, AreNoneWithoutALevelOfOneFringe) {
  EXPECT_TRUE(levels_of({2, 8, 64}).empty());
  EXPECT_TRUE(levels_of({62, 64}).empty());
  EXPECT_TRUE(levels_of({}).empty());
  EXPECT_EQ(levels_of({1.0000001, 8}).size(), 2U) << "rounding";
  EXPECT_TRUE(levels_of({1.001, 8}).empty());
}

TEST(FindUnwrapLevels, SkipLevelsThatTheNoiseDoesNotNeed) {
  // An order is wrong beyond pi; of a ratio r the noise is sigma sqrt(1 + r^2). At 1e-6 a deviate
  // is below 4.9 sigma: from 1 to 4 and to 16 at 0.1 rad (0.41), but not from 1 to 16 (1.6).
  EXPECT_EQ(levels_of({1, 4, 16}, 0.1), (Counts{1, 4, 16}));
  EXPECT_EQ(levels_of({1, 4, 16}, 0.03), (Counts{1, 16}));
  // The limit: pi / 4.892 = sigma sqrt(1 + 16^2).
  const double limit = 3.14159265 / 4.8916 / std::sqrt(257.0);
  EXPECT_EQ(levels_of({1, 4, 16}, 0.99 * limit), (Counts{1, 16}));
  EXPECT_EQ(levels_of({1, 4, 16}, 1.01 * limit), (Counts{1, 15, 16})) << "the beat of 16 and 1";
}

TEST(FindUnwrapLevels, CountTheNoiseOfBothMapsOfABeat) {
  const std::vector<Pattern> patterns = patterns_with({63, 64});
  const auto levels = find_unwrap_levels(patterns, field_of_columns());
  // From the beat of one fringe to 63: sigma sqrt(2 63^2 + 1).
  const double limit = 3.14159265 / 4.8916 / std::sqrt(2.0 * 63.0 * 63.0 + 1.0);
  EXPECT_TRUE(is_safe(levels, 0.99 * limit, 1e-6));
  EXPECT_FALSE(is_safe(levels, 1.01 * limit, 1e-6));
  EXPECT_TRUE(is_safe(levels, 1.01 * limit, 2e-6));
  EXPECT_FALSE(is_safe({}, 0.0, 1.0));
}

}  // namespace
}  // namespace frangia
