#include "frangia/calibrate/check/drift_log.h"

#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "support/temporary_folder.h"

namespace frangia {
namespace {

using testing::TemporaryFolder;

DriftEntry check_at(double time_s, double deviation_mm) {
  return {time_s,
          "/scans/bar\t1",
          "ball-bar",
          {{"spacing", deviation_mm, 0.002, 0.02, ""}, {"form <1>", 0.001, 0.001, 0.01, ""}}};
}

TEST(DriftLog, KeepsEachCheckOnceAndInTheOrderOfTime) {
  const TemporaryFolder folder;
  const auto log = drift_log_path(folder.path() / "rig.toml");
  EXPECT_EQ(log.filename(), "rig.drift.txt");
  EXPECT_TRUE(read_drift_log(log).empty());
  append_drift(log, check_at(1.8e9 + 3600.0, 0.015));
  append_drift(log, check_at(1.8e9, 0.004));
  append_drift(log, check_at(1.8e9, 0.004));
  const auto entries = read_drift_log(log);
  ASSERT_EQ(entries.size(), 2U);
  EXPECT_EQ(entries[0].time_s, 1.8e9);
  EXPECT_EQ(entries[0].scan, "/scans/bar 1");
  ASSERT_EQ(entries[0].items.size(), 2U);
  EXPECT_EQ(entries[0].items[1].name, "form <1>");
  EXPECT_EQ(entries[1].items[0].deviation_mm, 0.015);
  EXPECT_EQ(entries[1].items[0].limit_mm, 0.02);
}

TEST(DriftLog, PassesOverDamagedLinesWithAWarning) {
  const TemporaryFolder folder;
  const auto log = folder.path() / "rig.drift.txt";
  append_drift(log, check_at(1.8e9, 0.004));
  std::ofstream(log, std::ios::app) << "drift\tnonsense crc=00000000\n";
  std::string warning;
  frangia::Run run;
  run.on_warning = [&](const std::string& sentence) { warning = sentence; };
  EXPECT_EQ(read_drift_log(log, run).size(), 1U);
  EXPECT_NE(warning.find("1 of 3 lines"), std::string::npos) << warning;
}

TEST(DriftPlot, DrawsEachFigureWithItsLimitsAndTimes) {
  const std::vector<DriftEntry> entries = {check_at(1764240970.0, 0.004),
                                           check_at(1764244570.0, 0.031)};
  const std::string svg = drift_plot(entries);
  EXPECT_NE(svg.find("ball-bar: spacing"), std::string::npos);
  EXPECT_NE(svg.find("form &lt;1>"), std::string::npos);
  EXPECT_NE(svg.find("2025-11-27T10:56:10Z"), std::string::npos);
  EXPECT_NE(svg.find("fill=\"#c33\"><title>2025-11-27T11:56:10Z: +0.0310"), std::string::npos);
  EXPECT_TRUE(drift_plot({}).empty());
}

}  // namespace
}  // namespace frangia
