// The verbs scan, devices and calibrate piezo: exit codes and one sentence.
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "frangia/rig/read_rig.h"
#include "frangia/rig/write_rig.h"

#include "support/run_program.h"
#include "support/small_scan.h"
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

TEST_F(CaptureProgram, EndsWithCode4AndATableWhenViewsWereSkipped) {
  const std::string stuck = rig("[devices.turntable]\ndriver = \"simulated\"",
                                "[devices.turntable]\ndriver = \"simulated\"\n"
                                "faults = [\"stuck 120 always\"]");
  const std::string command = "scan " + stuck + " -o " + scan() + " --views 3";
  const Answer answer = run_program(command);
  EXPECT_EQ(answer.exit_code, 4) << answer.output;
  EXPECT_TRUE(holds(answer, "1 view not captured")) << answer.output;
  EXPECT_TRUE(holds(answer, "     2         120  simulated turntable: did not reach 120 degrees"))
      << answer.output;
  const Answer json = run_program("--json " + command + " 2>/dev/null");
  EXPECT_EQ(json.exit_code, 4);
  EXPECT_TRUE(holds(json, "\"view\": 2,")) << json.output;
  EXPECT_EQ(run_program("scan " + rig() + " -o " + scan() + " --views 3").exit_code, 0)
      << "freed, the same command captures what is missing";
}

TEST_F(CaptureProgram, FindsTheSameScanUnderAnyNameOfItsFolder) {
  const std::string rest = rig() + " --views 1 -o ";
  EXPECT_EQ(run_program("scan " + rest + scan() + "/").exit_code, 0);
  for (const std::string& folder : {scan(), scan() + "/", scan() + "/../scan"}) {
    const Answer answer = run_program("scan " + rest + folder);
    EXPECT_EQ(answer.exit_code, 0) << answer.output;
    EXPECT_TRUE(holds(answer, "0 frames captured, 5 already there")) << answer.output;
  }
  const Answer here = run_shell(fmt::format("cd {} && {} scan {}.", scan(), FRANGIA_PROGRAM, rest));
  EXPECT_EQ(here.exit_code, 0) << here.output;
  std::filesystem::rename(scan(), folder_.path() / "moved");
  EXPECT_EQ(run_program("scan " + rest + (folder_.path() / "moved").string()).exit_code, 0);
  std::ifstream in(folder_.path() / "moved/scan.toml");
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  EXPECT_NE(text.find("name = \"moved\""), std::string::npos) << text;
}

TEST_F(CaptureProgram, IsRefusedAFolderThatAnotherScanWritesTo) {
  const std::string slow = rig("part = \"plate\"", "part = \"plate\"\nreal_time = true");
  const std::string command =
      fmt::format("{} scan {} -o {} --views 3 --exposure 200", FRANGIA_PROGRAM, slow, scan());
  const Answer answer = run_shell(
      fmt::format("{} >/dev/null 2>&1 & first=$!; until ls {}/views/*/*-1.png >/dev/null 2>&1 || "
                  "! kill -0 $first; do sleep 0.05; done; {}; echo code $? first $first; "
                  "kill -KILL $first; wait $first",
                  command,
                  scan(),
                  command));
  EXPECT_TRUE(holds(answer, "code 3")) << answer.output;
  EXPECT_TRUE(holds(answer, "is writing to this folder")) << answer.output;
  const std::size_t id = answer.output.find("first ") + 6;
  const std::string process = answer.output.substr(id, answer.output.find('\n', id) - id);
  EXPECT_TRUE(holds(answer, "process " + process + " on ")) << answer.output;
  EXPECT_EQ(run_shell(command).exit_code, 0) << "the lock of a killed process is taken over";
}

TEST_F(CaptureProgram, NeedsTheTableAngleToContinueWithoutAHomeSwitch) {
  const std::string here = rig("[devices.turntable]\ndriver = \"simulated\"",
                               "[devices.turntable]\ndriver = \"simulated\"\n"
                               "home = \"here\"\nfaults = [\"stuck 120 always\"]");
  const std::string command = "scan " + here + " -o " + scan() + " --views 3";
  EXPECT_EQ(run_program(command).exit_code, 4);
  const std::string freed = "scan " +
                            rig("[devices.turntable]\ndriver = \"simulated\"",
                                "[devices.turntable]\ndriver = \"simulated\"\nhome = \"here\"") +
                            " -o " + scan() + " --views 3";
  const Answer refused = run_program(freed);
  EXPECT_EQ(refused.exit_code, 3) << refused.output;
  EXPECT_TRUE(holds(refused, "set --table-at to 0")) << refused.output;
  EXPECT_EQ(run_program(freed + " --table-at 0").exit_code, 0);
}

TEST_F(CaptureProgram, CalibratesADisplayIntoACopyOfARigOfWhichOnlySizesAreKnown) {
  const auto path = [&](const char* name) { return (folder_.path() / name).string(); };
  Rig truth = read_rig(std::string(FRANGIA_SOURCE_DIR) + "/examples/python/small-rig.toml");
  testing::make_coarser(truth.reference().model, 2);
  write_rig(path("truth.toml"), truth);
  std::ofstream(path("maker.toml"))
      << "format = \"frangia-rig\"\nversion = 1\n\n[camera]\nsize_px = [160, 128]\n\n"
         "[projector]\nmodel = \"pinhole\"\nsize_px = [640, 400]\n\n"
         "[devices.camera]\ndriver = \"simulated\"\npart = \"plate\"\n"
         "true_rig = \"truth.toml\"\ndisplay_gamma = 2.2\nlate_frames = 1\n\n"
         "[devices.fringes]\ndriver = \"simulated-display\"  # kept\nlatency_ms = 30\n";
  const std::string measured = path("display.toml");
  const Answer first = run_program("calibrate display " + path("maker.toml") + " -o " + measured);
  EXPECT_EQ(first.exit_code, 0) << first.output;
  EXPECT_TRUE(holds(first, "frames are late by 1")) << first.output;
  EXPECT_TRUE(holds(first, "latency 30 ms: delay_s = 0.03")) << first.output;
  std::ifstream in(measured);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  EXPECT_NE(text.find("skip_frames = 1"), std::string::npos) << text;
  EXPECT_NE(text.find("# kept"), std::string::npos);
  const Answer again = run_program("calibrate display " + measured + " -o " + measured);
  EXPECT_EQ(again.exit_code, 0) << again.output;
  EXPECT_FALSE(holds(again, "frames are")) << again.output;
  for (const Answer* answer : {&first, &again})  // 0.5^2.2; the second time through its table
    EXPECT_TRUE(holds(*answer, "half of full drive gives 21.") ||
                holds(*answer, "half of full drive gives 22."))
        << answer->output;
  EXPECT_EQ(run_program("calibrate display " + rig()).exit_code, 3) << "it has no projector";
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
