#include "frangia/acquisition/plan_setup.h"

#include "frangia/core/angles.h"
#include "frangia/reconstruct/reconstruct.h"

#include "support/error_of.h"
#include "support/simulated_capture.h"

namespace frangia {
namespace {

using testing::error_of;

class PlanSetup : public testing::SimulatedCapture {
 protected:
  PlanSetup() { views(2); }

  CaptureReport capture_setup(int setup, CaptureOptions options = {}) {
    plan_ = plan_setup(plan_, setup);
    options.setup = setup;
    return capture(options);
  }
};

TEST_F(PlanSetup, OfANewScanIsThePlan) {
  const Scan plan = plan_setup(plan_, 0);
  ASSERT_EQ(plan.views.size(), 2U);
  EXPECT_EQ(plan.views[1].folder, "views/001");
  EXPECT_EQ(plan.views[1].setup, 0);
  EXPECT_EQ(last_setup(plan_.folder), 0);
}

TEST_F(PlanSetup, AppendsViewsToACompleteScanAndKeepsItsFrames) {
  static_cast<void>(capture_setup(0));
  const auto before = images();
  views(3);
  const CaptureReport report = capture_setup(1);
  EXPECT_EQ(report.captured, 15U);
  EXPECT_EQ(last_setup(plan_.folder), 1);
  const Scan scan = read_scan(plan_.folder);
  ASSERT_EQ(scan.views.size(), 5U);
  EXPECT_EQ(scan.views[1].setup, 0);
  EXPECT_EQ(scan.views[2].setup, 1);
  EXPECT_EQ(scan.views[2].folder, "views/002");
  EXPECT_EQ(scan.views[2].angle_rad, 0.0);
  const auto after = images();
  for (const auto& [name, bytes] : before)
    EXPECT_TRUE(after.at(name) == bytes) << name;
  // A later session finds everything, from the plan of either setup.
  views(3);
  EXPECT_EQ(capture_setup(1).captured, 0U);
  views(2);
  EXPECT_EQ(capture_setup(0).captured, 0U);
  EXPECT_EQ(read_scan(plan_.folder).views.size(), 5U);
}

TEST_F(PlanSetup, AddsViewsToASetup) {
  views(2);
  static_cast<void>(capture_setup(0));
  const auto before = images();
  // Stations between those of the first session, in the same setup.
  views(2);
  plan_.views.push_back({kPi / 2, "views/002"});
  plan_.views.push_back({3 * kPi / 2, "views/003"});
  EXPECT_EQ(capture_setup(0).captured, 10U);
  const Scan scan = read_scan(plan_.folder);
  ASSERT_EQ(scan.views.size(), 4U);
  for (const ScanView& view : scan.views)
    EXPECT_EQ(view.setup, 0);
  EXPECT_NEAR(scan.views[2].angle_rad, kPi / 2, 1e-9);
  const auto after = images();
  for (const auto& [name, bytes] : before)
    EXPECT_TRUE(after.at(name) == bytes) << name;
  // The plan of the first session still finds all of them, and a further setup follows.
  views(2);
  EXPECT_EQ(capture_setup(0).captured, 0U);
  EXPECT_EQ(read_scan(plan_.folder).views.size(), 4U);
  views(2);
  EXPECT_EQ(capture_setup(1).captured, 10U);
  EXPECT_EQ(read_scan(plan_.folder).views.back().folder, "views/005");
}

TEST_F(PlanSetup, InterruptedGoesOnToTheSameBytesAndLeavesTheFirstSetupUsable) {
  static_cast<void>(capture_setup(0));
  views(2);
  static_cast<void>(capture_setup(1));
  const auto whole = bytes();
  std::filesystem::remove_all(plan_.folder);
  views(2);
  static_cast<void>(capture_setup(0));
  for (const double stop_at : {0.55, 0.8}) {
    views(2);
    stop_ = std::stop_source();
    stop_at_ = stop_at;
    EXPECT_FALSE(error_of([&] { static_cast<void>(capture_setup(1)); }).empty());
    EXPECT_EQ(read_scan(plan_.folder).views.size(), 2U);
  }
  stop_ = std::stop_source();
  stop_at_ = 2.0;
  views(2);
  EXPECT_GT(capture_setup(1).resumed, 10U);
  EXPECT_TRUE(bytes() == whole);
}

/// A session that died between the manifest's line of the new plan and the plan itself.
TEST_F(PlanSetup, KilledBeforeThePlanIsWrittenGoesOn) {
  static_cast<void>(capture_setup(0));
  const std::string before = testing::text_of(plan_.folder / "capture/scan.toml");
  views(2);
  static_cast<void>(capture_setup(1));
  std::ofstream(plan_.folder / "capture/scan.toml", std::ios::binary) << before;
  views(2);
  EXPECT_EQ(capture_setup(1).captured, 0U);
  EXPECT_EQ(last_setup(plan_.folder), 1);
}

TEST_F(PlanSetup, DoesNotCaptureAMissingViewOfAnEarlierSetup) {
  devices_["camera"] += "faults = [\"lost 1 fringe 2\"]\n";
  EXPECT_EQ(capture_setup(0, {.view_attempts = 1}).skipped.size(), 1U);
  views(2);
  const CaptureReport report = capture_setup(1);
  EXPECT_EQ(report.captured, 10U);
  EXPECT_TRUE(report.skipped.empty());
  const Scan scan = read_scan(plan_.folder);
  ASSERT_EQ(scan.views.size(), 3U);
  EXPECT_EQ(scan.views[1].setup, 1);
}

TEST_F(PlanSetup, RefusesASetupBeforeTheOneBeforeIt) {
  EXPECT_NE(
      error_of([&] { static_cast<void>(plan_setup(plan_, 1)); }).find("setup 0 is not captured"),
      std::string::npos);
  static_cast<void>(capture_setup(0));
  views(2);
  EXPECT_NE(
      error_of([&] { static_cast<void>(plan_setup(plan_, 2)); }).find("setup 1 is not captured"),
      std::string::npos);
  EXPECT_FALSE(error_of([&] { static_cast<void>(plan_setup(plan_, -1)); }).empty());
}

TEST_F(PlanSetup, OfAnotherLengthIsRefusedOnceItHasBegun) {
  static_cast<void>(capture_setup(0));
  views(2);
  static_cast<void>(capture_setup(1));
  views(3);
  EXPECT_NE(error_of([&] { static_cast<void>(capture_setup(1)); }).find("holds another scan"),
            std::string::npos);
}

}  // namespace
}  // namespace frangia
