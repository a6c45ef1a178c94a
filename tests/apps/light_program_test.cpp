// The light of a scan goes off however the program ends.
#include <algorithm>
#include <cerrno>
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
#include <sys/prctl.h>
#include <sys/wait.h>

#include "support/emulated_boards.h"
#include "support/emulated_grbl.h"
#include "support/misbehaving_device.h"
#include "support/pseudo_terminal_test.h"
#include "support/run_program.h"
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

/// A scan whose light and table are on a GRBL board and whose other light is an instrument.
class LightOfAScan : public testing::PseudoTerminalTest {
 protected:
  LightOfAScan()
      : board_(std::make_unique<MisbehavingDevice>(std::make_unique<EmulatedGrbl>())),
        supply_(std::make_unique<EmulatedScpi>(), EmulatedPort::Kind::Tcp) {
    // The guardian of a program that dies becomes a child of this process, which can wait for it.
    ::prctl(PR_SET_CHILD_SUBREAPER, 1);            // NOLINT(*-vararg)
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
  /// Sends signals while the light is on, `delay_s` after it went on. Returns how the program
  /// ended.
  [[nodiscard]] int signal_while_lit(const std::vector<int>& signals, double delay_s) {
    // A board that was stopped in a motion is locked, and the table is homed before the next scan.
    board_.with<MisbehavingDevice>(
        [](auto& device) { device.template inner<EmulatedGrbl>().alarm = false; });
    StartedProgram program(command(), output());
    bool was_lit = false;
    EXPECT_TRUE(wait_until([&] { return (was_lit = is_lit()) || program.has_ended(); }));
    EXPECT_TRUE(was_lit) << "the light did not go on: " << testing::text_of(output());
    std::this_thread::sleep_for(std::chrono::duration<double>(delay_s));
    for (const int signal : signals)
      program.send(signal);
    return program.wait();
  }
  /// The light stays off when the program and its guardian have ended and the devices have received
  /// what they sent. `./run faults` measures how soon.
  void expect_dark() {
    EXPECT_TRUE(wait_until([] { return ::waitpid(-1, nullptr, WNOHANG) < 0 && errno == ECHILD; }));
    EXPECT_TRUE(
        wait_until([&] { return board_.has_received_all() && supply_.has_received_all(); }));
    EXPECT_FALSE(is_lit());
  }

  testing::TemporaryFolder folder_;
  EmulatedPort board_;
  EmulatedPort supply_;
  int scans_ = 0;
};

TEST_F(LightOfAScan, GoesOffAfterEachSignalWhichStopsTheScan) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) {
    EXPECT_EQ(signal_while_lit({signal}, 0.1), 130) << signal << testing::text_of(output());
    expect_dark();
  }
}

TEST_F(LightOfAScan, GoesOffAfterASecondSignalThatFollowsAtOnce) {
  for (const int signal : {SIGINT, SIGTERM, SIGQUIT}) {
    SCOPED_TRACE(signal);
    static_cast<void>(signal_while_lit({signal, signal}, 0.1));
    expect_dark();
  }
}

TEST_F(LightOfAScan, GoesOffWhenTheProgramIsKilledOrCrashesAtAnyMoment) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> moment(0.0, 0.6);
  for (const int signal : {SIGKILL, SIGSEGV, SIGABRT, SIGKILL, SIGUSR1}) {
    SCOPED_TRACE(signal);
    EXPECT_EQ(signal_while_lit({signal}, moment(random)), 128 + signal);
    expect_dark();
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
  EXPECT_TRUE(wait_until([&] { return !testing::text_of(code_file).empty(); }));
  EXPECT_EQ(testing::text_of(code_file), "141\n");
  expect_dark();
}

TEST_F(LightOfAScan, GoesOffOnABoardThatStopsAnsweringWhileTheOtherDevicesAreMadeSafe) {
  StartedProgram program(command(), output());
  ASSERT_TRUE(wait_until([&] { return is_lit(); }));
  board_.with<MisbehavingDevice>([](auto& device) {
    device.silent = true;
    device.chatter_every = std::chrono::milliseconds(30);
  });
  program.send(SIGINT);
  program.send(SIGINT);
  ASSERT_TRUE(wait_until([&] { return program.has_ended(); }));
  static_cast<void>(program.wait());
  expect_dark();
}

TEST_F(LightOfAScan, ARepeatedCommandWaitsForThePortOfAKilledProgram) {
  const auto times_lit = [&] {
    return board_.with<MisbehavingDevice>([](auto& device) {
      const auto& commands = device.template inner<EmulatedGrbl>().commands;
      return std::count_if(commands.begin(), commands.end(), [](const std::string& command) {
        return command.rfind("M3", 0) == 0;
      });
    });
  };
  EXPECT_EQ(signal_while_lit({SIGKILL}, 0.1), 128 + SIGKILL);
  EXPECT_TRUE(wait_until([&] { return board_.has_received_all(); }));
  const auto before = times_lit();
  StartedProgram program(command(), output());
  EXPECT_TRUE(wait_until([&] { return times_lit() > before; })) << testing::text_of(output());
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
