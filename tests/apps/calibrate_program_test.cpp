// The verbs calibrate board and calibrate rig: files, exit codes and one sentence.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

#include <gtest/gtest.h>

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
using testing::TemporaryFolder;
using testing::text_of;

TEST(CalibrateProgram, WritesABoardAtTrueScale) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "board.pdf";
  const Answer answer = run_program("calibrate board -o " + file.string());
  EXPECT_EQ(answer.exit_code, 0) << answer.output;
  EXPECT_NE(answer.output.find("square_mm = 22"), std::string::npos) << answer.output;
  const std::string pdf = text_of(file);
  EXPECT_EQ(pdf.substr(0, 5), "%PDF-");
  // A4 in points, and squares of 22 mm = 62.36 points.
  EXPECT_NE(pdf.find("841.88"), std::string::npos);
  EXPECT_NE(pdf.find("62.36221 62.36221 re"), std::string::npos) << pdf.substr(0, 3000);
  const Answer even = run_program("calibrate board --corners 9,7 -o " + file.string());
  EXPECT_EQ(even.exit_code, 3);
  EXPECT_NE(even.output.find("looks the same upside down"), std::string::npos) << even.output;
}

TEST(CalibrateProgram, RefinesARigByAScanAndRefusesWhatCannotRefineIt) {
  const TemporaryFolder folder;
  const std::string rig = (folder.path() / "small.toml").string();
  write_rig(rig, testing::small_rig("digital"));
  const std::string scan = (folder.path() / "scan").string();
  ASSERT_EQ(run_program("simulate ball-bar --views 4 --rig " + rig + " -o " + scan).exit_code, 0);
  const std::string out = (folder.path() / "refined.toml").string();
  const Answer kept = run_program("calibrate refine " + scan + " -o " + out);
  EXPECT_EQ(kept.exit_code, 0) << kept.output;
  EXPECT_NE(kept.output.find("the rig is kept"), std::string::npos) << kept.output;
  EXPECT_EQ(read_rig(out).projector.position_mm,
            testing::small_rig("digital").projector.position_mm);
  const Answer scaled = run_program("calibrate refine " + scan + " --length 70.7mm -o " + out);
  EXPECT_EQ(scaled.exit_code, 0) << scaled.output;
  const double ratio = read_rig(out).projector.position_mm.norm() /
                       testing::small_rig("digital").projector.position_mm.norm();
  EXPECT_NEAR(ratio, 1.01, 0.001);
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "refined-covariance.csv"));
  const std::string one = (folder.path() / "one").string();
  ASSERT_EQ(run_program("simulate ball-bar --views 1 --rig " + rig + " -o " + one).exit_code, 0);
  const Answer refused = run_program("calibrate refine " + one + " -o " + out);
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_NE(refused.output.find("needs several views"), std::string::npos) << refused.output;
}

/// Scans a part with a calibrated rig, and reconstructs it with and without the covariance.
void expect_systematic_part(const std::filesystem::path& folder, const std::filesystem::path& rig) {
  std::ofstream(rig, std::ios::app)
      << "\n[turntable]\npoint_mm = [3.5, 55.0, 496.0]\naxis = [0.0, -1.0, 0.0]\n";
  const std::string scan = (folder / "scan").string();
  const Answer simulated =
      run_program("simulate ball-bar --rig " + rig.string() + " --views 1 -o " + scan);
  ASSERT_EQ(simulated.exit_code, 0) << simulated.output;
  const std::string reconstruct = "reconstruct " + scan + " -o " + (folder / "a.ply").string();
  const Answer answer = run_program(reconstruct);
  EXPECT_EQ(answer.exit_code, 0) << answer.output;
  EXPECT_NE(answer.output.find(" mm (noise 0."), std::string::npos) << answer.output;
  EXPECT_NE(
      run_program("--json " + reconstruct + " 2>/dev/null").output.find("\"systematic_mm\": 0."),
      std::string::npos);
  EXPECT_NE(text_of(folder / "a.ply").find("property float sigma_systematic_mm\n"),
            std::string::npos);
  std::filesystem::remove(folder / "scan/rig-covariance.csv");
  const Answer missing = run_program(reconstruct);
  EXPECT_EQ(missing.exit_code, 3);
  EXPECT_NE(missing.output.find("rig-covariance.csv"), std::string::npos) << missing.output;
}

TEST(CalibrateProgram, WritesACharucoBoardWithItsKeys) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "board.pdf";
  const Answer answer =
      run_program("calibrate board --kind charuco --corners 6,4 -o " + file.string());
  EXPECT_EQ(answer.exit_code, 0) << answer.output;
  EXPECT_NE(answer.output.find("dictionary = \"DICT_5X5_100\""), std::string::npos)
      << answer.output;
  EXPECT_EQ(text_of(file).substr(0, 5), "%PDF-");
  const Answer picture = run_program("calibrate board -o " + (folder.path() / "b.png").string());
  EXPECT_EQ(picture.exit_code, 3);
  EXPECT_NE(picture.output.find("ends with .pdf"), std::string::npos) << picture.output;
}

/// Writes the digital rig with `divisor` times fewer pixels of its camera on a side; returns the
/// option that takes it.
std::string with_small_rig(const TemporaryFolder& folder, int divisor = 2) {
  const std::string rig = (folder.path() / "small.toml").string();
  write_rig(rig, testing::small_rig("digital", divisor));
  return " --rig " + rig;
}

TEST(CalibrateProgram, FindsTheAxisOfASimulatedTurntable) {
  const TemporaryFolder folder;
  const std::string turned = (folder.path() / "turned").string();
  const auto rig = folder.path() / "rig.toml";
  const Answer simulated =
      run_program("simulate --calibration checkerboard --on-turntable --views 3 --samples 4 -o " +
                  turned + with_small_rig(folder));
  ASSERT_EQ(simulated.exit_code, 0) << simulated.output;
  const Answer answer = run_program("calibrate turntable " + turned + " --rig " + turned +
                                    "/truth-rig.toml -o " + rig.string());
  EXPECT_EQ(answer.exit_code, 0) << answer.output;
  EXPECT_NE(answer.output.find("axis from 3 views"), std::string::npos) << answer.output;
  const Turntable truth = read_rig(folder.path() / "turned" / "truth-rig.toml").turntable.value();
  const Turntable found = read_rig(rig).turntable.value();
  EXPECT_LT(std::acos(found.axis.dot(truth.axis)), 0.001);
  const Eigen::Vector3d offset = found.point_mm - truth.point_mm;
  EXPECT_LT((offset - truth.axis * truth.axis.dot(offset)).norm(), 0.1);
}

TEST(CalibrateProgram, WritesTheRigOfSimulatedPosesAndNoneForAFault) {
  const TemporaryFolder folder;
  const std::string poses = (folder.path() / "poses").string();
  const auto rig = folder.path() / "rig.toml";
  const Answer simulated =
      run_program("simulate --calibration checkerboard --views 5 --samples 1 -o " + poses +
                  with_small_rig(folder, 4));
  ASSERT_EQ(simulated.exit_code, 0) << simulated.output;
  std::ofstream(folder.path() / "poses/rig.toml", std::ios::app)
      << "\n[devices.camera]\ndriver = \"simulated\"\n";
  const Answer answer = run_program("calibrate rig " + poses + " -o " + rig.string());
  EXPECT_EQ(answer.exit_code, 0) << answer.output;
  EXPECT_NE(answer.output.find("calibrated by 5 poses of a checkerboard of 10 x 7 points"),
            std::string::npos)
      << answer.output;
  EXPECT_TRUE(read_rig(rig).calibration);
  EXPECT_NE(text_of(rig).find("[devices.camera]"), std::string::npos);
  EXPECT_EQ(text_of(folder.path() / "rig-covariance.csv").substr(0, 26),
            "parameter,camera.focal_px,");
  expect_systematic_part(folder.path(), rig);

  std::ofstream(folder.path() / "poses/scan.toml", std::ios::app) << "\n# end\n";
  std::string scan = text_of(folder.path() / "poses/scan.toml");
  const std::string corners = "corners = [10, 7]";
  ASSERT_NE(scan.find(corners), std::string::npos) << scan;
  scan.replace(scan.find(corners), corners.size(), "corners = [8, 6]");
  std::ofstream(folder.path() / "poses/scan.toml") << scan;
  const auto other = folder.path() / "other.toml";
  const Answer wrong = run_program("calibrate rig " + poses + " -o " + other.string());
  EXPECT_EQ(wrong.exit_code, 3);
  EXPECT_NE(wrong.output.find("set corners = [10, 7]"), std::string::npos) << wrong.output;
  EXPECT_FALSE(std::filesystem::exists(other));
}

TEST(CalibrateTargets, DrawsDiscsAndMarkersAtTrueScale) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "targets.pdf";
  const Answer answer = run_program(
      "calibrate targets --discs 3 --diameter 4mm --coded 2 --marker 9mm -o " + file.string());
  EXPECT_EQ(answer.exit_code, 0) << answer.output;
  EXPECT_NE(answer.output.find("diameter_mm = 4\ndisc = \"dark\""), std::string::npos);
  EXPECT_NE(answer.output.find("marker_mm = 9"), std::string::npos);
  const std::string pdf = text_of(file);
  EXPECT_EQ(pdf.substr(0, 5), "%PDF-");
  // A cell of a marker of six is 1.5 mm, 4.25197 points.
  EXPECT_NE(pdf.find("4.25197 4.25197 re"), std::string::npos);
}

TEST(CalibrateTargets, RefusesWhatCannotBePrintedInOneSentence) {
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "targets.pdf").string();
  const std::pair<const char*, const char*> faults[] = {
      {"--dictionary DICT_9X9_50", "\"DICT_9X9_50\" is unknown"},
      {"--coded 60", "DICT_4X4_50 has the codes 0 to 49"},
      {"--diameter 300mm", "does not fit on paper"},
      {"--discs 0 --coded 0", "there is no target to print"}};
  for (const auto& [options, names] : faults) {
    const Answer answer = run_program(std::string("calibrate targets ") + options + " -o " + file);
    EXPECT_NE(answer.exit_code, 0);
    EXPECT_NE(answer.output.find(names), std::string::npos) << answer.output;
    EXPECT_FALSE(std::filesystem::exists(file));
  }
}

}  // namespace
}  // namespace frangia
