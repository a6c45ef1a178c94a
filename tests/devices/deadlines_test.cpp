// Boards that misbehave: no wait takes longer than its deadline, and the light goes off.
#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/devices/internal/board_devices.h"
#include "frangia/devices/internal/message_instrument.h"
#include "frangia/devices/internal/open_transport.h"

#include "support/emulated_boards.h"
#include "support/emulated_grbl.h"
#include "support/error_of.h"
#include "support/misbehaving_device.h"
#include "support/pseudo_terminal_test.h"
#include "support/soon.h"
#include "support/wait_until.h"

namespace frangia {
namespace {

using testing::EmulatedGrbl;
using testing::EmulatedMarlin;
using testing::EmulatedPort;
using testing::EmulatedScpi;
using testing::error_of;
using testing::kPatience_s;
using testing::MisbehavingDevice;
using testing::returns;
using testing::soon;
using testing::wait_until;

using Fault = void (*)(MisbehavingDevice&);
const std::vector<Fault> kFaults = {
    [](MisbehavingDevice& device) { device.chatter_every = std::chrono::milliseconds(30); },
    [](MisbehavingDevice& device) { device.flood = true; },
    [](MisbehavingDevice& device) { device.endless_line = true; },
    [](MisbehavingDevice& device) { device.silent = true; }};

class BoundedWaits : public testing::PseudoTerminalTest {};

TEST_F(BoundedWaits, AGrblBoardThatMisbehavesIsDarkAndStoppedInTime) {
  for (std::size_t i = 0; i < kFaults.size(); ++i) {
    EmulatedPort port(std::make_unique<MisbehavingDevice>(std::make_unique<EmulatedGrbl>()));
    MotionControllerSettings settings;
    settings.boot_s = 0.3;
    const std::shared_ptr<MotionController> board = make_grbl(open_serial({port.path()}), settings);
    board->connect(soon());
    StepperTurntable table(board);
    BoardSwitch laser(board, "M3 S1000", "M5");
    laser.set(true, soon());
    port.with<MisbehavingDevice>([&](auto& device) { kFaults[i](device); });
    EXPECT_TRUE(returns([&] { laser.make_safe(); })) << i;
    EXPECT_TRUE(returns([&] { table.make_safe(); })) << i;
    EXPECT_TRUE(wait_until([&] {
      return port.with<MisbehavingDevice>(
          [](auto& device) { return !device.template inner<EmulatedGrbl>().spindle; });
    })) << i;
  }
}

TEST_F(BoundedWaits, ACommandFailsAtItsDeadlineWhateverTheBoardSends) {
  for (std::size_t i = 0; i < kFaults.size(); ++i) {
    EmulatedPort port(std::make_unique<MisbehavingDevice>(std::make_unique<EmulatedGrbl>()));
    port.with<MisbehavingDevice>([&](auto& device) {
      device.silent = true;
      device.chatter = "<Idle|MPos:0,0,0>\r\n";
      kFaults[i](device);
    });
    const auto firmware = make_grbl(open_serial({port.path()}));
    EXPECT_TRUE(returns([&] { EXPECT_THROW(firmware->command("M5", Deadline::in(0.3)), Error); }))
        << i;
  }
}

TEST_F(BoundedWaits, DiscardingTheInputOfABoardThatNeverPausesEnds) {
  EmulatedPort port(std::make_unique<MisbehavingDevice>(std::make_unique<EmulatedGrbl>()));
  port.with<MisbehavingDevice>([](auto& device) { device.flood = true; });
  const auto line = open_serial({port.path()});
  EXPECT_TRUE(returns([&] { line->discard_input(); }));
}

TEST_F(BoundedWaits, AStopRequestEndsAReadFromABoardThatNeverPauses) {
  EmulatedPort port(std::make_unique<MisbehavingDevice>(std::make_unique<EmulatedGrbl>()));
  port.with<MisbehavingDevice>([](auto& device) {
    device.flood = device.silent = true;
    device.chatter = "<Idle|MPos:0,0,0>\r\n";
  });
  const auto firmware = make_grbl(open_serial({port.path()}));
  std::stop_source stop;
  stop.request_stop();
  const std::string sentence =
      error_of([&] { firmware->command("M5", Deadline::in(kPatience_s, stop.get_token())); });
  EXPECT_NE(sentence.find("stopped by the user"), std::string::npos) << sentence;
}

TEST_F(BoundedWaits, AHalfWrittenCommandIsEndedBeforeTheOffCommands) {
  EmulatedPort port(std::make_unique<EmulatedScpi>(), EmulatedPort::Kind::Tcp);
  MessageInstrument instrument(open_tcp("127.0.0.1", port.tcp_port(), soon()),
                               {"SYST:ERR?", "0", "\n", "*IDN?"});
  instrument.send("OUTP ON", soon());
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(instrument.send("VOLT:OFFS 1", Deadline::in(kPatience_s, stop.get_token())), Error);
  instrument.send_unchecked({"OUTP OFF"});
  EXPECT_NE(instrument.identify(soon()), "");
  port.with<EmulatedScpi>([](auto& supply) { EXPECT_FALSE(supply.output); });
}

TEST_F(BoundedWaits, MarlinSwitchesACustomOutputOffWhenTheTableFails) {
  EmulatedPort port(std::make_unique<EmulatedMarlin>());
  MotionControllerSettings settings;
  settings.boot_s = 0.3;
  const std::shared_ptr<MotionController> board = make_marlin(open_serial({port.path()}), settings);
  board->connect(soon());
  BoardSwitch lamp(board, "M42 P4 S255", "M42 P4 S0");
  lamp.set(true, soon());
  board->stop();
  lamp.make_safe();
  EXPECT_TRUE(wait_until(
      [&] { return port.with<EmulatedMarlin>([](auto& marlin) { return !marlin.pin; }); }));
}

class MoveTimes : public testing::PseudoTerminalTest {};

TEST_F(MoveTimes, FollowTheLimitsThatGrblReports) {
  EmulatedPort port(std::make_unique<EmulatedGrbl>());
  // 600 units per minute, 20 units per s²; homing at 300 and 60 units per minute over 360 units.
  port.with<EmulatedGrbl>([](auto& grbl) {
    grbl.settings[110] = 600.0;
    grbl.settings[120] = 20.0;
    grbl.settings[24] = 60.0;
    grbl.settings[25] = 300.0;
    grbl.settings[27] = 5.0;
    grbl.settings[130] = 360.0;
  });
  MotionControllerSettings settings;
  settings.boot_s = 0.3;
  const std::shared_ptr<MotionController> board = make_grbl(open_serial({port.path()}), settings);
  board->connect(soon());
  StepperTurntableOptions options;
  options.speed_deg_per_s = 30.0;
  options.settle_s = 0.25;
  options.info.can_home = true;
  StepperTurntable table(board, options);
  table.enable(true, soon());
  table.home(soon());
  // 90 degrees at 10 degrees per s, two ramps of 0.5 s each way, and the time to settle.
  EXPECT_NEAR(table.move_time_s(rad_from_deg(90.0)), 9.0 + 0.5 + 0.5 + 0.25, 1e-9);
  EXPECT_NEAR(table.home_time_s(), 1.5 * 360.0 / 5.0 + 4.0 * 5.0 / 1.0, 1e-9);
}

TEST_F(MoveTimes, FollowTheRateThatMarlinReports) {
  EmulatedPort port(std::make_unique<EmulatedMarlin>());
  port.with<EmulatedMarlin>([](auto& marlin) { marlin.max_rate = 5.0; });
  MotionControllerSettings settings;
  settings.boot_s = 0.3;
  const std::shared_ptr<MotionController> board = make_marlin(open_serial({port.path()}), settings);
  board->connect(soon());
  StepperTurntable table(board);
  EXPECT_NEAR(table.home_time_s(), 0.0, 1e-9);
  table.enable(true, soon());
  table.home(soon());
  EXPECT_NEAR(table.move_time_s(rad_from_deg(90.0)), 18.0, 1e-9);
}

class FirstCause : public testing::PseudoTerminalTest {};

TEST_F(FirstCause, AnAlarmIsNamedByTheMoveAndByLaterCommands) {
  EmulatedPort port(std::make_unique<EmulatedGrbl>());
  MotionControllerSettings settings;
  settings.boot_s = 0.3;
  const std::shared_ptr<MotionController> board = make_grbl(open_serial({port.path()}), settings);
  board->connect(soon());
  StepperTurntable table(board);
  table.enable(true, soon());
  table.home(soon());
  port.with<EmulatedGrbl>([](auto& grbl) { grbl.limit_in_next_move = true; });
  const std::string moved = error_of([&] { table.move_to(1.0, soon()); });
  EXPECT_NE(moved.find("ALARM:1, a limit switch was hit"), std::string::npos) << moved;
  const std::string later = error_of([&] { board->command("G1 X1 F100", soon()); });
  EXPECT_NE(later.find("ALARM:1, a limit switch was hit; refused G1 X1 F100 (error:9)"),
            std::string::npos)
      << later;
}

TEST_F(FirstCause, AQueryThatAnInstrumentRefusesReportsItsErrorQueue) {
  EmulatedPort port(std::make_unique<EmulatedScpi>(), EmulatedPort::Kind::Tcp);
  MessageInstrument instrument(open_tcp("127.0.0.1", port.tcp_port(), soon()),
                               {"SYST:ERR?", "0", "\n", "*IDN?"});
  const std::string sentence =
      error_of([&] { static_cast<void>(instrument.ask("STAT:SETTLED?", Deadline::in(0.2))); });
  EXPECT_NE(sentence.find("reports -113,\"Undefined header\" after 'STAT:SETTLED?'"),
            std::string::npos)
      << sentence;
}

}  // namespace
}  // namespace frangia
