#include "frangia/simulate/default_patterns.h"

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/simulate/rig_presets.h"

namespace frangia {
namespace {

TEST(DefaultPatterns, OfARigWithALineAreOneFringePatternAndTheLine) {
  const auto patterns = default_patterns(rig_preset("carducci"));
  ASSERT_EQ(patterns.size(), 2U);
  EXPECT_EQ(patterns[0].fringes_per_degree, 1.0);
  ASSERT_EQ(patterns[0].shifts_rad.size(), 4U);
  EXPECT_NEAR(patterns[0].shifts_rad[3], rad_from_deg(270.0), 1e-12);
  EXPECT_EQ(patterns[1].kind, PatternKind::Line);
}

TEST(DefaultPatterns, WithoutALineDoubleFromAtMostOneFringeOverTheField) {
  Rig rig = rig_preset("carducci");
  rig.laser_sheet.reset();
  const auto patterns = default_patterns(rig);
  EXPECT_LE(patterns.front().fringes_per_degree * 24.0, 1.0);
  EXPECT_GT(patterns.front().fringes_per_degree * 24.0, 0.5);
  for (std::size_t i = 1; i < patterns.size(); ++i) {
    EXPECT_EQ(patterns[i].fringes_per_degree, 2.0 * patterns[i - 1].fringes_per_degree);
  }
  EXPECT_EQ(patterns.back().fringes_per_degree, 1.0);
}

TEST(DefaultPatterns, OfAPinholeProjectorRunFromItsWidthToThe64th) {
  const auto patterns = default_patterns(rig_preset("digital"));
  ASSERT_EQ(patterns.size(), 3U);
  EXPECT_EQ(patterns[0].period_px, 1280.0);
  EXPECT_EQ(patterns[1].period_px, 160.0);
  EXPECT_EQ(patterns[2].period_px, 20.0);
}

TEST(DefaultPatterns, TakeGivenPeriodsFromCoarseToFine) {
  PatternPlan plan;
  plan.periods_px = {18.0, 1280.0, 144.0};
  plan.shifts = 3;
  const auto patterns = default_patterns(rig_preset("digital"), plan);
  EXPECT_EQ(patterns[0].period_px, 1280.0);
  EXPECT_EQ(patterns[2].period_px, 18.0);
  EXPECT_EQ(patterns[2].frame_count(), 3);
}

TEST(DefaultPatterns, RefuseWhatTheProjectorCannotShow) {
  const auto refuses = [](const char* preset, const PatternPlan& plan) {
    EXPECT_THROW(static_cast<void>(default_patterns(rig_preset(preset), plan)), Error);
  };
  PatternPlan periods;
  periods.periods_px = {1280.0, 160.0, 20.0};
  refuses("angular", periods);
  periods.sequence = "doubling";
  refuses("digital", periods);
  refuses("digital", {.periods_px = {1280.0, 1.0}});
  refuses("digital", {.sequence = "doubling", .fringes = 1280.0});
  refuses("digital", {.sequence = "doubling", .fringes = 1e300});
  refuses("angular", {.fringes_per_degree = 1e300});
}

TEST(DefaultPatterns, RefuseTwoShiftsAndNoPitch) {
  PatternPlan two;
  two.shifts = 2;
  EXPECT_THROW(static_cast<void>(default_patterns(rig_preset("digital"), two)), Error);
  PatternPlan none;
  none.fringes_per_degree = 0.0;
  EXPECT_THROW(static_cast<void>(default_patterns(rig_preset("carducci"), none)), Error);
}

}  // namespace
}  // namespace frangia
