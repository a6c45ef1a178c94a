// The verbs scan, devices and calibrate piezo: exit codes and one sentence.
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/run_program.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

using testing::Answer;
using testing::run_program;
using testing::run_shell;

class CaptureProgram : public ::testing::Test {
 protected:
  /// Writes the small simulated rig with `from` replaced by `to`.
  [[nodiscard]] std::string rig(const std::string& from = "", const std::string& to = "") const {
    std::ifstream in(std::string(FRANGIA_SOURCE_DIR) + "/tests/data/small-interferometer.toml");
    std::string text{std::istreambuf_iterator<char>(in), {}};
    if (!from.empty()) text.replace(text.find(from), from.size(), to);
    const auto file = folder_.path() / "rig.toml";
    std::ofstream(file) << text;
    return file.string();
  }
  [[nodiscard]] std::string scan() const { return (folder_.path() / "scan").string(); }

  testing::TemporaryFolder folder_;
};

bool holds(const Answer& answer, const std::string& part) {
  return answer.output.find(part) != std::string::npos;
}

TEST_F(CaptureProgram, TestsEachDeviceOfARigAndNamesTheOneThatFails) {
  const Answer well = run_program("devices --no-search " + rig());
  EXPECT_EQ(well.exit_code, 0) << well.output;
  EXPECT_TRUE(holds(well, "[devices.camera] works: simulated camera: 160 x 160 pixels"));
  const Answer ill =
      run_program("devices --no-search " +
                  rig("[devices.turntable]\ndriver = \"simulated\"",
                      "[devices.turntable]\ndriver = \"grbl\"\nport = \"/dev/nothing-there\""));
  EXPECT_EQ(ill.exit_code, 4) << ill.output;
  EXPECT_TRUE(holds(ill, "[devices.turntable] FAULT: /dev/nothing-there: cannot be opened"))
      << ill.output;
  EXPECT_TRUE(holds(ill, "1 of the 5 devices"));
}

TEST_F(CaptureProgram, AnUnknownDriverIsNamedWithTheKnownOnes) {
  const Answer answer = run_program(
      "scan " + rig("driver = \"simulated-piezo\"", "driver = \"crystal\"") + " -o " + scan());
  EXPECT_EQ(answer.exit_code, 3);
  EXPECT_TRUE(
      holds(answer, "devices.fringes.driver is \"crystal\"; the drivers for [devices.fringes] are"))
      << answer.output;
}

TEST_F(CaptureProgram, IsStoppedByASignalAndContinues) {
  // As slow as a real rig, so that the signal arrives during the capture.
  const std::string slow = rig("part = \"plate\"", "part = \"plate\"\nreal_time = true");
  const std::string command =
      fmt::format("{} scan {} -o {} --views 3 --exposure 200", FRANGIA_PROGRAM, slow, scan());
  // The signal is sent once a frame is stored, however slow the machine is.
  const Answer stopped = run_shell(fmt::format(
      "{} & until ls {}/views/*/*-1.png >/dev/null 2>&1 || ! kill -0 $!; do sleep 0.05; done; "
      "kill -TERM $!; wait $!",
      command,
      scan()));
  EXPECT_EQ(stopped.exit_code, 130) << stopped.output;
  EXPECT_TRUE(holds(stopped, "stopped by the user"));
  const Answer finished = run_shell(command);
  EXPECT_EQ(finished.exit_code, 0) << finished.output;
  EXPECT_FALSE(holds(finished, " 0 already there")) << finished.output;
  EXPECT_TRUE(holds(finished, "view 3 of 3 at 240 degrees"));
}

TEST_F(CaptureProgram, CalibratesAPiezoIntoACopyOfItsRig) {
  const std::string copy = (folder_.path() / "calibrated.toml").string();
  const Answer answer = run_program("calibrate piezo " + rig() + " --steps 13 -o " + copy);
  EXPECT_EQ(answer.exit_code, 0) << answer.output;
  EXPECT_TRUE(holds(answer, "curve_commands = [0, 1, 2"));
  std::ifstream in(copy);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  EXPECT_NE(text.find("curve_phases_deg = [0.000, 37."), std::string::npos) << text;  // 5 % too far
  EXPECT_EQ(text.find("command_per_turn"), std::string::npos);
  EXPECT_EQ(run_program("devices --no-search " + copy).exit_code, 0);
}

}  // namespace
}  // namespace frangia
