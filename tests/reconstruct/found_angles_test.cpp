// Angles that the registration finds, for what rests on the stated ones.
#include "frangia/reconstruct/internal/found_angles.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"

namespace frangia {
namespace {

/// Three views, of which the last stood at 100 degrees and not at 90.
struct TurnedScan {
  Scan scan;
  std::vector<MeasuredSetup> setups;

  TurnedScan() {
    MeasuredSetup& setup = setups.emplace_back();
    setup.measured.unwrapped_spatially = true;
    RegistrationReport report;
    for (int view = 0; view < 3; ++view) {
      const double angle_rad = rad_from_deg(45.0 * view);
      const std::string folder = "views/" + std::to_string(view);
      scan.views.push_back({angle_rad, folder});
      setup.measured.stations.push_back({angle_rad, folder});
      report.given_angles_rad.push_back(angle_rad);
      report.angles_rad.push_back(angle_rad);
    }
    report.angles_rad[2] = rad_from_deg(100.0);
    report.explanation.best = PoseCause::AnglesWrong;
    setup.registration = report;
  }
};

TEST(FoundAngles, ReplaceThoseByWhichOtherViewsDecidedFringeOrders) {
  const TurnedScan turned;
  const auto found = with_found_angles(turned.scan, turned.setups);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->scan.views[1].angle_rad, rad_from_deg(45.0));
  EXPECT_EQ(found->scan.views[2].angle_rad, rad_from_deg(100.0));
  EXPECT_EQ(found->explanation.best, PoseCause::AnglesWrong);
}

TEST(FoundAngles, ChangeNothingThatDoesNotRestOnThem) {
  TurnedScan turned;
  turned.setups.front().measured.unwrapped_spatially = false;
  EXPECT_FALSE(with_found_angles(turned.scan, turned.setups));
}

TEST(FoundAngles, AreNotTakenFromARegistrationThatIsNotTrusted) {
  TurnedScan turned;
  turned.setups.front().registration->trustworthy = false;
  EXPECT_FALSE(with_found_angles(turned.scan, turned.setups));
}

TEST(FoundAngles, AreNearThoseStatedWhereNothingElseIsSaid) {
  TurnedScan turned;
  turned.setups.front().registration->explanation.best = PoseCause::AsStated;
  EXPECT_FALSE(with_found_angles(turned.scan, turned.setups));
  EXPECT_FALSE(may_hide_angles(turned.setups));
}

TEST(FoundAngles, MayBeHiddenWhereViewsAreLeftOut) {
  TurnedScan turned;
  turned.setups.front().registration->outliers = {1};
  EXPECT_TRUE(may_hide_angles(turned.setups));
}

}  // namespace
}  // namespace frangia
