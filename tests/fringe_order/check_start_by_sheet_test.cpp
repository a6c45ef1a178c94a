#include "frangia/fringe_order/check_start_by_sheet.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace frangia {
namespace {

constexpr double kWholeTurn = 6.283185307179586;

/// The phase on a line across an angular projector's field, by psi = atan2(x, z).
SequenceCheck check_line(double sign, double late_deg, double field_deg) {
  Projector projector;
  projector.model = AngularModel{-0.3, 0.3};
  WrappedPhase phase{.pattern = {.name = "fringe",
                                 .fringes_per_degree = 1.0,
                                 .shifts_rad = {0.0, 1.570796, 3.141593, 4.712389}},
                     .phase_rad = Image<float>(4, 60)};
  std::vector<ProfilePoint> profile;
  for (int y = 0; y < 60; ++y) {
    const double psi_deg = field_deg * (y - 30) / 60.0;
    const double psi = psi_deg / 360.0 * kWholeTurn;
    profile.push_back({{2.0, y}, {500.0 * std::tan(psi), 0.0, 500.0}, 0.1});
    const double measured = sign * kWholeTurn * psi_deg + late_deg / 360.0 * kWholeTurn;
    phase.phase_rad(2, y) = static_cast<float>(std::remainder(measured, kWholeTurn));
  }
  return check_start_by_sheet(phase, profile, projector);
}

TEST(CheckStartBySheet, NamesAWrongStartAndReversedShifts) {
  EXPECT_TRUE(check_line(1.0, 0.0, 8.0).consistent);
  EXPECT_TRUE(check_line(1.0, 0.0, 8.0).decided);
  const SequenceCheck late = check_line(1.0, 180.0, 8.0);
  ASSERT_EQ(late.fits.size(), 1U);
  EXPECT_EQ(late.fits.front().what, "a start of 180 degrees, not 0 degrees");
  // A start near a whole number of quarter turns is one: schemes have no others.
  EXPECT_EQ(check_line(1.0, 97.0, 8.0).fits.at(0).what, "a start of 90 degrees, not 0 degrees");
  const SequenceCheck reversed = check_line(-1.0, 0.0, 8.0);
  ASSERT_EQ(reversed.fits.size(), 1U);
  EXPECT_EQ(reversed.fits.front().what, "shifts in the opposite direction");
}

TEST(CheckStartBySheet, DoesNotBlameTheDirectionWhereThePhaseHardlyChangesAlongTheLine) {
  EXPECT_TRUE(check_line(1.0, 0.0, 0.2).consistent);
}

}  // namespace
}  // namespace frangia
