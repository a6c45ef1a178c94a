#include "frangia/dataset/write_scan.h"

#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"

#include "support/small_folder.h"

namespace frangia {
namespace {

using testing::expect_names;
using testing::SmallFolder;

TEST(WriteScan, WritesWhatReadScanReadsBack) {
  const SmallFolder folder;
  Scan scan = read_scan(folder.path());
  scan.name = R"(a "quoted" \ name)";
  write_scan(scan);
  const Scan back = read_scan(folder.path());
  EXPECT_EQ(back.name, scan.name);
  EXPECT_EQ(back.patterns[0].shifts_rad, scan.patterns[0].shifts_rad);
  EXPECT_EQ(back.views[0].folder, scan.views[0].folder);
}

TEST(WriteScan, KeepsEveryKindOfPatternAndEverySetup) {
  const SmallFolder folder;
  Scan scan = read_scan(folder.path());
  scan.rig.projector.model =
      PinholeModel{.width_px = 1280, .height_px = 800, .focal_px = {1900.0, 1900.0}};
  const double third_rad = rad_from_deg(120.0);
  scan.patterns = {{.name = "fine", .period_px = 20.0},
                   {.name = "code", .kind = PatternKind::Gray},
                   {.name = "ramp", .kind = PatternKind::Ramp}};
  scan.patterns[0].direction = FringeDirection::Horizontal;
  scan.patterns[0].shifts_rad = {0.0, third_rad, 2.0 * third_rad};
  scan.patterns[0].exposures_ms = {2.5, 10.0};
  scan.patterns[1].bits = 8;
  scan.patterns[1].stripe_px = 10.0;
  scan.patterns[2].levels = {0.0, 0.5, 1.0};
  scan.views.push_back({third_rad, "views/001", 1});
  scan.part_poses[1] = Eigen::Translation3d(0.0, 0.5, 70.0) *
                       Eigen::AngleAxisd(0.3, Eigen::Vector3d(1.0, 2.0, 2.0) / 3.0);
  write_scan(scan);
  const Scan back = read_scan(folder.path());
  EXPECT_EQ(back.patterns[0].direction, FringeDirection::Horizontal);
  EXPECT_EQ(back.patterns[0].period_px, 20.0);
  EXPECT_EQ(back.patterns[0].exposures_ms, scan.patterns[0].exposures_ms);
  ASSERT_EQ(back.patterns[0].shifts_rad.size(), 3U);
  EXPECT_NEAR(back.patterns[0].shifts_rad[2], 2.0 * third_rad, 1e-12);
  EXPECT_EQ(back.patterns[1].bits, 8);
  EXPECT_EQ(back.patterns[1].stripe_px, 10.0);
  EXPECT_EQ(back.patterns[2].levels, scan.patterns[2].levels);
  EXPECT_EQ(back.views[0].setup, 0);
  EXPECT_EQ(back.views[1].setup, 1);
  EXPECT_NEAR(back.views[1].angle_rad, third_rad, 1e-12);
  EXPECT_TRUE(back.part_poses.at(1).isApprox(scan.part_poses.at(1), 1e-10));
}

TEST(WriteScan, KeepsTheTargets) {
  const SmallFolder folder;
  Scan scan = read_scan(folder.path());
  scan.targets = TargetSet{.diameter_mm = 4.0,
                           .tone = TargetTone::Light,
                           .dictionary = "DICT_5X5_100",
                           .marker_mm = 9.5,
                           .sticker_mm = 16.0,
                           .distances = {{3, 17, 250.013, 0.004}}};
  write_scan(scan);
  const Scan back = read_scan(folder.path());
  ASSERT_TRUE(back.targets.has_value());
  EXPECT_EQ(back.targets->diameter_mm, 4.0);
  EXPECT_EQ(back.targets->tone, TargetTone::Light);
  EXPECT_EQ(back.targets->dictionary, "DICT_5X5_100");
  EXPECT_EQ(back.targets->marker_mm, 9.5);
  EXPECT_EQ(back.targets->sticker_mm, 16.0);
  ASSERT_EQ(back.targets->distances.size(), 1U);
  EXPECT_EQ(back.targets->distances[0].second, 17);
  EXPECT_EQ(back.targets->distances[0].distance_mm, 250.013);
  EXPECT_EQ(back.targets->distances[0].sigma_mm, 0.004);
}

TEST(WriteScan, WritesRoundNumbersAsPeopleDo) {
  const SmallFolder folder;
  Scan scan = read_scan(folder.path());
  scan.views[0].angle_rad = rad_from_deg(120.0);
  write_scan(scan);
  std::ifstream in(folder.path() / "scan.toml");
  const std::string text((std::istreambuf_iterator<char>(in)), {});
  expect_names(text, "angle_deg = 120.0\n");
  expect_names(text, "version = 2\n");
}

}  // namespace
}  // namespace frangia
