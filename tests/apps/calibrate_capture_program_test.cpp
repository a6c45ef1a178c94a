// The verb calibrate capture on simulated devices: poses from a pipe, its end, and continuation.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "frangia/dataset/scan_folder.h"
#include "frangia/rig/read_rig.h"
#include "frangia/rig/write_rig.h"

#include "support/run_program.h"
#include "support/small_scan.h"
#include "support/temporary_folder.h"
#include "support/text_of.h"

namespace frangia {
namespace {

using testing::Answer;
using testing::run_program;
using testing::run_shell;

class CaptureOfPoses : public ::testing::Test {
 protected:
  CaptureOfPoses() { write_rig(folder_.path() / "truth.toml", testing::small_rig("digital", 4)); }

  /// A maker's rig that states sizes only; its devices simulate truth.toml.
  [[nodiscard]] std::string maker_rig(const std::string& camera_keys = "") const {
    const auto file = folder_.path() / "maker.toml";
    std::ofstream(file) << "format = \"frangia-rig\"\nversion = 1\n"
                           "[camera]\nsize_px = [240, 192]\n"
                           "[projector]\nmodel = \"pinhole\"\nsize_px = [1280, 800]\n"
                           "[devices.camera]\ndriver = \"simulated\"\ntrue_rig = \"truth.toml\"\n"
                        << camera_keys
                        << "[devices.fringes]\ndriver = \"simulated-display\"\n"
                           "[devices.turntable]\ndriver = \"simulated\"\n";
    return file.string();
  }
  [[nodiscard]] std::string poses() const { return (folder_.path() / "poses").string(); }
  [[nodiscard]] std::string capture(const std::string& rig, const std::string& options) const {
    return fmt::format(
        "{} calibrate capture {} -o {} --square 14mm {}", FRANGIA_PROGRAM, rig, poses(), options);
  }

  testing::TemporaryFolder folder_;
};

bool says(const Answer& answer, const std::string& part) {
  return answer.output.find(part) != std::string::npos;
}

TEST_F(CaptureOfPoses, GoesOnWhereAPipeEndedAndCalibratesTheRig) {
  const std::string command = capture(maker_rig(), "--poses 4");
  const Answer two = run_shell(R"(printf '\n\n' | )" + command);
  EXPECT_EQ(two.exit_code, 0) << two.output;
  EXPECT_TRUE(says(two, "pose 1: 70 of 70 points")) << two.output;
  EXPECT_TRUE(says(two, "2 poses with the board")) << two.output;
  EXPECT_TRUE(says(two, "the same command goes on")) << two.output;
  const Answer four = run_shell(R"(printf '\n\n\n' | )" + command);
  EXPECT_EQ(four.exit_code, 0) << four.output;
  EXPECT_TRUE(says(four, "4 poses with the board")) << four.output;
  EXPECT_EQ(read_scan(poses(), {}, RigContent::StartValues).views.size(), 4U);
  const auto found = folder_.path() / "rig.toml";
  const Answer calibrated = run_program("calibrate rig " + poses() + " -o " + found.string());
  ASSERT_EQ(calibrated.exit_code, 0) << calibrated.output;
  EXPECT_NE(testing::text_of(found).find("[devices.turntable]"), std::string::npos);
  const Rig truth = read_rig(folder_.path() / "truth.toml");
  const Rig rig = read_rig(found);
  EXPECT_NEAR(rig.reference().model.focal_px.x() / truth.reference().model.focal_px.x(), 1.0, 0.01);
  EXPECT_NEAR(rig.projector.position_mm.norm() / truth.projector.position_mm.norm(), 1.0, 0.02);
}

TEST_F(CaptureOfPoses, WithoutAPoseEndsWithOneSentenceAndNoScan) {
  const Answer none = run_shell("true | " + capture(maker_rig(), ""));
  EXPECT_EQ(none.exit_code, 3) << none.output;
  EXPECT_TRUE(says(none, "no view was captured")) << none.output;
  EXPECT_FALSE(std::filesystem::exists(poses() + "/scan.toml"));
  EXPECT_EQ(run_program("calibrate capture " + maker_rig() + " -o x --square 0").exit_code, 2);
}

TEST_F(CaptureOfPoses, OnTheTurntableNeedsNobody) {
  const std::string rig = maker_rig();
  std::ofstream(rig, std::ios::app)
      << "[calibration]\ndate = \"2026-01-01\"\nboard = \"checkerboard\"\nposes = 12\n"
         "camera_rms_px = 0.1\nprojector_rms_px = 0.1\ncovariance = \"rig-covariance.csv\"\n";
  const Answer answer = run_shell(capture(rig, "--table --poses 3") + " </dev/null");
  EXPECT_EQ(answer.exit_code, 0) << answer.output;
  EXPECT_EQ(testing::text_of(poses() + "/rig.toml").find("covariance"), std::string::npos)
      << "the poses name a file that is elsewhere";
  const Scan scan = read_scan(poses(), {}, RigContent::StartValues);
  ASSERT_EQ(scan.views.size(), 3U);
  EXPECT_NEAR(scan.views[2].angle_rad - scan.views[0].angle_rad, rad_from_deg(60.0), 1e-9);
  EXPECT_TRUE(says(answer, "pose 3: 70 of 70 points")) << answer.output;
}

TEST_F(CaptureOfPoses, LeavesOutAPoseThatWasInterrupted) {
  const std::string command = capture(maker_rig("real_time = true\n"), "--poses 2 --exposure 100");
  // The pipe stays open until the program has received SIGTERM.
  const Answer stopped = run_shell(fmt::format(
      "(echo; until test -e {2}; do sleep 0.05; done) 2>/dev/null | {0} & until ls "
      "{1}/views/*/*-1.png "
      ">/dev/null 2>&1 || ! kill -0 $!; do sleep 0.05; done; kill -TERM $!; touch {2}; wait $!",
      command,
      poses(),
      (folder_.path() / "stopped").string()));
  EXPECT_EQ(stopped.exit_code, 130) << stopped.output;
  EXPECT_TRUE(says(stopped, "continue with: ")) << stopped.output;
  const Answer finished = run_shell("printf '\\n' | " + command);
  EXPECT_EQ(finished.exit_code, 0) << finished.output;
  const Scan scan = read_scan(poses(), {}, RigContent::StartValues);
  ASSERT_EQ(scan.views.size(), 1U);
  EXPECT_EQ(scan.views[0].folder, "views/001");
}

}  // namespace
}  // namespace frangia
