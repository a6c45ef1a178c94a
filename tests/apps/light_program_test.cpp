// The light of a scan goes off however the program ends.
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "frangia/devices/deadline.h"

#include "support/emulated_boards.h"
#include "support/emulated_grbl.h"
#include "support/misbehaving_device.h"
#include "support/pseudo_terminal_test.h"
#include "support/run_program.h"
#include "support/slowdown.h"
#include "support/started_program.h"
#include "support/temporary_folder.h"
#include "support/text_of.h"
#include "support/wait_until.h"

namespace frangia {
namespace {

using testing::EmulatedGrbl;
using testing::EmulatedPort;
using testing::EmulatedScpi;
using testing::MisbehavingDevice;
using testing::StartedProgram;
using testing::wait_until;

constexpr double kOff_s = 0.5 * testing::kSlowdown;

/// A scan whose light and table are on a GRBL board and whose other light is an instrument.
class LightOfAScan : public testing::PseudoTerminalTest {
 protected:
  LightOfAScan()
      : board_(std::make_unique<MisbehavingDevice>(std::make_unique<EmulatedGrbl>())),
        supply_(std::make_unique<EmulatedScpi>(), EmulatedPort::Kind::Tcp) {
    ::setenv("ASAN_OPTIONS", "handle_segv=0", 1);  // the program dies of the signal, as without
    std::ifstream in(std::string(FRANGIA_SOURCE_DIR) + "/tests/data/small-interferometer.toml");
    std::string text{std::istreambuf_iterator<char>(in), {}};
    text.replace(text.find("[devices.line]"), std::string::npos, "");
    const std::string camera = "part = \"plate\"\n";
    text.insert(text.find(camera) + camera.size(), "real_time = true\n");
    const std::string grbl = "driver = \"grbl\"\nboot_s = 0.3\n" + board_.settings();
    text += "[devices.light]\n" + grbl + "[devices.turntable]\n" + grbl +
            "[devices.line]\ndriver = \"scpi\"\n" + supply_.settings();
    std::ofstream(rig()) << text;
  }
  [[nodiscard]] std::string rig() const { return (folder_.path() / "rig.toml").string(); }
  [[nodiscard]] std::string output() const { return (folder_.path() / "output.txt").string(); }

  /// A scan of many views, each frame exposed for 30 ms.
  [[nodiscard]] std::vector<std::string> command() {
    return {FRANGIA_PROGRAM,
            "scan",
            rig(),
            "-o",
            (folder_.path() / fmt::format("scan-{}", ++scans_)).string(),
            "--views",
            "40",
            "--exposure",
            "30",
            "--patience",
            "2"};
  }
  [[nodiscard]] bool is_lit() {
    return board_.with<MisbehavingDevice>([](auto& device) {
      return device.template inner<EmulatedGrbl>().spindle;
    }) || supply_.with<EmulatedScpi>([](auto& supply) { return supply.output; });
  }
  /// Sends a signal while the light is on, `delay_s` after it went on. Returns the seconds until
  /// the light is off.
  [[nodiscard]] double seconds_of_light_after(const std::vector<int>& signals,
                                              double delay_s,
                                              int& exit_code) {
    // A board that was stopped in a motion is locked, and the table is homed before the next scan.
    board_.with<MisbehavingDevice>(
        [](auto& device) { device.template inner<EmulatedGrbl>().alarm = false; });
    StartedProgram program(command(), output());
    static_cast<void>(wait_until([&] { return is_lit() || program.has_ended(); }, 20.0));
    if (!is_lit()) ADD_FAILURE() << "the light did not go on: " << testing::text_of(output());
    std::this_thread::sleep_for(std::chrono::duration<double>(delay_s));
    for (const int signal : signals)
      program.send(signal);
    // Between two lights there is a moment without any; the light is off when it stays off.
    const auto begin = Deadline::Clock::now();
    double seconds = 0.0;
    for (double dark_s = 0.0; dark_s < 0.3 * testing::kSlowdown && seconds < 10.0;) {
      const double now_s = std::chrono::duration<double>(Deadline::Clock::now() - begin).count();
      if (is_lit()) seconds = now_s;
      dark_s = now_s - seconds;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    exit_code = program.wait();
    return seconds;
  }

  testing::TemporaryFolder folder_;
  EmulatedPort board_;
  EmulatedPort supply_;
  int scans_ = 0;
};

TEST_F(LightOfAScan, GoesOffAfterEachSignalWhichStopsTheScan) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) {
    int code = 0;
    EXPECT_LT(seconds_of_light_after({signal}, 0.1, code), kOff_s) << signal;
    EXPECT_EQ(code, 130) << signal << testing::text_of(output());
  }
}

TEST_F(LightOfAScan, GoesOffAfterASecondSignalThatFollowsAtOnce) {
  for (const int signal : {SIGINT, SIGTERM, SIGQUIT}) {
    int code = 0;
    EXPECT_LT(seconds_of_light_after({signal, signal}, 0.1, code), kOff_s) << signal;
  }
}

TEST_F(LightOfAScan, GoesOffWhenTheProgramIsKilledOrCrashesAtAnyMoment) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> moment(0.0, 0.6);
  for (const int signal : {SIGKILL, SIGSEGV, SIGABRT, SIGKILL, SIGUSR1}) {
    int code = 0;
    EXPECT_LT(seconds_of_light_after({signal}, moment(random), code), kOff_s) << signal;
    EXPECT_EQ(code, 128 + signal);
  }
}

TEST_F(LightOfAScan, GoesOffWhenTheReaderOfTheOutputEnds) {
  std::string line;
  for (const std::string& word : command())
    line += word + " ";
  const auto code_file = folder_.path() / "code";
  const testing::Answer answer = testing::run_shell(
      fmt::format("{{ {} --verbose; echo $? >{}; }} 2>&1 | head -n 1", line, code_file.string()));
  EXPECT_FALSE(answer.output.empty());
  EXPECT_GE(wait_until([&] { return !testing::text_of(code_file).empty(); }, 20.0), 0.0);
  EXPECT_EQ(testing::text_of(code_file), "141\n");
  EXPECT_FALSE(is_lit());
}

TEST_F(LightOfAScan, GoesOffOnABoardThatStopsAnsweringWhileTheOtherDevicesAreMadeSafe) {
  StartedProgram program(command(), output());
  ASSERT_GE(wait_until([&] { return is_lit(); }, 20.0), 0.0);
  board_.with<MisbehavingDevice>([](auto& device) {
    device.silent = true;
    device.chatter_every = std::chrono::milliseconds(30);
  });
  program.send(SIGINT);
  program.send(SIGINT);
  EXPECT_GE(wait_until([&] { return program.has_ended(); }, 5.0 * testing::kSlowdown), 0.0);
  EXPECT_GE(wait_until([&] { return !is_lit(); }, kOff_s), 0.0);
}

TEST_F(LightOfAScan, ARepeatedCommandWaitsForThePortOfAKilledProgram) {
  int code = 0;
  EXPECT_LT(seconds_of_light_after({SIGKILL}, 0.1, code), kOff_s);
  StartedProgram program(command(), output());
  EXPECT_GE(wait_until([&] { return is_lit(); }, 20.0), 0.0) << testing::text_of(output());
}

TEST_F(LightOfAScan, IsNotSwitchedOnForAPatternThatTheDevicesCannotShow) {
  const std::string rig_file =
      std::string(FRANGIA_SOURCE_DIR) + "/examples/simulated-interferometer.toml";
  const testing::Answer answer = testing::run_program(
      fmt::format("scan {} --ramp 17 -o {}", rig_file, (folder_.path() / "ramp").string()));
  EXPECT_EQ(answer.exit_code, 3) << answer.output;
  EXPECT_NE(answer.output.find("scan without --ramp"), std::string::npos) << answer.output;
}

}  // namespace
}  // namespace frangia
