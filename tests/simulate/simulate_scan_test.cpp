#include "frangia/simulate/simulate_scan.h"

#include <cmath>
#include <stop_token>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/dataset/read_frames.h"
#include "frangia/files/ply.h"
#include "frangia/simulate/default_patterns.h"
#include "frangia/simulate/parts.h"
#include "frangia/simulate/rig_presets.h"

#include "support/temporary_folder.h"

namespace frangia {
namespace {

class SimulateScan : public ::testing::Test {
 protected:
  [[nodiscard]] Scan plan() const {
    Scan scan;
    scan.folder = folder_;
    scan.name = "plate";
    scan.rig = rig_preset("carducci");
    scan.patterns = default_patterns(scan.rig);
    scan.views = {{0.0, "views/000"}, {rad_from_deg(45.0), "views/001"}};
    return scan;
  }

  testing::TemporaryFolder temporary_;
  std::filesystem::path folder_ = temporary_.path() / "scan";
};

TEST_F(SimulateScan, WritesAScanThatReadsBackWithTheTruthBeside) {
  SimulateOptions options;
  options.bits = 12;
  const Mesh part = make_plate();
  static_cast<void>(simulate_scan(part, plan(), options));
  std::vector<std::string> warnings;
  frangia::Run run;
  run.on_warning = [&](const std::string& sentence) { warnings.push_back(sentence); };
  const Scan scan = read_scan(folder_, run);
  EXPECT_TRUE(warnings.empty());
  EXPECT_EQ(scan.views.size(), 2U);
  EXPECT_EQ(scan.rig.reference().white_level, 4095);
  EXPECT_TRUE(scan.rig.reference().noise);
  const auto stacks = read_frames(scan, 1);
  ASSERT_EQ(stacks.size(), 2U);
  EXPECT_EQ(stacks[0].frames.size(), 4U);
  EXPECT_EQ(width_of(stacks[0].frames[0]), 512);
  EXPECT_EQ(read_ply(folder_ / "truth.ply").vertices_mm, part.vertices_mm);
}

TEST_F(SimulateScan, StatesTheTurntableAsExactWhereItHasNoFault) {
  SimulateOptions options;
  options.axis_offset_mm = 0.1;
  static_cast<void>(simulate_scan(make_plate(), plan(), options));
  const Turntable table = *read_scan(folder_).rig.turntable;
  EXPECT_TRUE(std::isnan(table.point_sigma_mm));
  EXPECT_EQ(table.axis_sigma_rad, 0.0);
  EXPECT_EQ(table.angle_sigma_rad, 0.0);
}

TEST_F(SimulateScan, InterruptedLeavesNoScanAndIsResumedFromTheStart) {
  std::stop_source source;
  frangia::Run run;
  run.stop = source.get_token();
  run.progress = [&](double done) {
    if (done > 0.7) source.request_stop();
  };
  EXPECT_THROW(static_cast<void>(simulate_scan(make_plate(), plan(), {}, run)), Error);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "views/000"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "scan.toml"));
  static_cast<void>(simulate_scan(make_plate(), plan()));
  EXPECT_EQ(read_frames(read_scan(folder_), 1).size(), 2U);
}

TEST_F(SimulateScan, DoesNotTouchAFolderThatHoldsSomethingElse) {
  std::filesystem::create_directories(folder_ / "views/000");
  EXPECT_THROW(static_cast<void>(simulate_scan(make_plate(), plan())), Error);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "views/000"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "rig.toml"));
}

TEST_F(SimulateScan, ReportsProgressThatNeverFallsAndEndsAtOne) {
  frangia::Run run;
  double last = 0.0;
  run.progress = [&](double done) {
    EXPECT_GE(done, last);
    last = done;
  };
  static_cast<void>(simulate_scan(make_plate(), plan(), {}, run));
  EXPECT_EQ(last, 1.0);
}

}  // namespace
}  // namespace frangia
