#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/devices/internal/board_devices.h"
#include "frangia/devices/internal/open_transport.h"

#include "support/emulated_boards.h"
#include "support/emulated_grbl.h"
#include "support/error_of.h"
#include "support/pseudo_terminal_test.h"
#include "support/soon.h"
#include "support/wait_until.h"

namespace frangia {
namespace {

using testing::EmulatedGrbl;
using testing::EmulatedHorus;
using testing::EmulatedMarlin;
using testing::EmulatedPort;
using testing::error_of;
using testing::kPatience_s;
using testing::soon;
using testing::wait_until;

class GrblTurntable : public testing::PseudoTerminalTest {};
class HorusTurntable : public testing::PseudoTerminalTest {};
class MarlinTurntable : public testing::PseudoTerminalTest {};

MotionControllerSettings quick() {
  MotionControllerSettings settings;
  settings.boot_s = 0.3;
  return settings;
}

/// A connected board.
std::shared_ptr<MotionController> ready(std::unique_ptr<MotionController> board) {
  board->connect(soon());
  return board;
}

void start(StepperTurntable& table) {
  table.enable(true, soon());
  table.home(soon());
}

StepperTurntableOptions options_with(double backlash_deg) {
  StepperTurntableOptions options;
  options.backlash_deg = backlash_deg;
  options.speed_deg_per_s = 90.0;
  return options;
}

std::unique_ptr<MotionController> grbl_at(const EmulatedPort& port) {
  return make_grbl(open_serial({port.path()}), quick());
}

TEST_F(GrblTurntable, IsAtStandstillAtTheAngleWhenAMoveReturns) {
  EmulatedPort port(std::make_unique<EmulatedGrbl>());
  port.with<EmulatedGrbl>([](auto& grbl) { grbl.speed_factor = 10.0; });
  StepperTurntable table(ready(grbl_at(port)), options_with(0.0));
  start(table);
  table.move_to(rad_from_deg(45.0), soon());
  port.with<EmulatedGrbl>([](auto& grbl) {
    EXPECT_FALSE(grbl.moving());
    EXPECT_NEAR(grbl.position(), 45.0, 1e-3);
  });
  EXPECT_NEAR(table.angle_rad().value(), rad_from_deg(45.0), 1e-12);
}

TEST_F(GrblTurntable, MovesByTheDifferenceFromAnAngleThatWasSet) {
  EmulatedPort port(std::make_unique<EmulatedGrbl>());
  port.with<EmulatedGrbl>([](auto& grbl) { grbl.speed_factor = 10.0; });
  StepperTurntable table(ready(grbl_at(port)), options_with(0.0));
  const auto position = [&] {
    double units = 0.0;
    port.with<EmulatedGrbl>([&](auto& grbl) { units = grbl.position(); });
    return units;
  };
  table.enable(true, soon());
  table.set_angle(rad_from_deg(90.0), soon());
  EXPECT_NEAR(table.angle_rad().value(), rad_from_deg(90.0), 1e-12);
  const double before = position();
  table.move_to(rad_from_deg(100.0), soon());
  EXPECT_NEAR(position() - before, 10.0, 1e-3);
  table.move_to(0.0, soon());
  EXPECT_NEAR(position() - before, -90.0, 1e-3);
  table.home(soon());
  EXPECT_EQ(table.angle_rad().value(), 0.0);
}

TEST_F(GrblTurntable, ApproachesEveryTargetFromBelow) {
  EmulatedPort port(std::make_unique<EmulatedGrbl>());
  StepperTurntable table(ready(grbl_at(port)), options_with(2.0));
  start(table);
  for (const double angle_deg : {0.0, 30.0, 31.0, 10.0}) {
    table.move_to(rad_from_deg(angle_deg), soon());
  }
  const auto targets = port.with<EmulatedGrbl>([](auto& grbl) { return grbl.targets; });
  EXPECT_EQ(targets, (std::vector<double>{-2.0, 0.0, 30.0, 31.0, 8.0, 10.0}));
}

TEST_F(GrblTurntable, LosesTheAngleOnAResetInMotionAndRefusesToMoveUntilHomed) {
  EmulatedPort port(std::make_unique<EmulatedGrbl>());
  StepperTurntable table(ready(grbl_at(port)), options_with(0.0));
  start(table);
  port.with<EmulatedGrbl>([](auto& grbl) { grbl.reset_in_next_move = true; });
  EXPECT_NE(error_of([&] { table.move_to(1.0, soon()); }).find("home the table again"),
            std::string::npos);
  EXPECT_FALSE(table.angle_rad().has_value());
  const auto moves = port.with<EmulatedGrbl>([](auto& grbl) { return grbl.targets.size(); });
  EXPECT_NE(error_of([&] { table.move_to(1.0, soon()); }).find("home it first"), std::string::npos);
  EXPECT_EQ(port.with<EmulatedGrbl>([](auto& grbl) { return grbl.targets.size(); }), moves);
  table.home(soon());
  table.move_to(rad_from_deg(20.0), soon());
  EXPECT_TRUE(table.angle_rad().has_value());
}

TEST_F(GrblTurntable, EnforcesItsOwnLimitsAndThoseOfTheBoard) {
  EmulatedPort port(std::make_unique<EmulatedGrbl>());
  port.with<EmulatedGrbl>([](auto& grbl) { grbl.travel = 100.0; });
  StepperTurntableOptions options = options_with(0.0);
  options.info.min_rad = 0.0;
  options.info.max_rad = rad_from_deg(170.0);
  StepperTurntable table(ready(grbl_at(port)), options);
  start(table);
  EXPECT_NE(error_of([&] { table.move_to(rad_from_deg(171.0), soon()); }).find("0 to 170"),
            std::string::npos);
  EXPECT_THROW(table.move_to(std::nan(""), soon()), Error);
  EXPECT_TRUE(table.angle_rad().has_value()) << "nothing has moved";
  EXPECT_NE(error_of([&] { table.move_to(rad_from_deg(120.0), soon()); }).find("ALARM:2"),
            std::string::npos);
  EXPECT_FALSE(table.angle_rad().has_value());
}

TEST_F(GrblTurntable, StopsAMoveAtItsDeadline) {
  EmulatedPort port(std::make_unique<EmulatedGrbl>());
  port.with<EmulatedGrbl>([](auto& grbl) { grbl.speed_factor = 0.001; });
  StepperTurntable table(ready(grbl_at(port)), options_with(0.0));
  start(table);
  EXPECT_NE(error_of([&] { table.move_to(1.0, Deadline::in(0.2)); }).find("no answer within 0.2 s"),
            std::string::npos);
  EXPECT_TRUE(wait_until(
      [&] { return port.with<EmulatedGrbl>([](auto& grbl) { return !grbl.moving(); }); }));
}

TEST_F(GrblTurntable, StopsWaitingOnAStopRequest) {
  EmulatedPort port(std::make_unique<EmulatedGrbl>());
  port.with<EmulatedGrbl>([](auto& grbl) { grbl.speed_factor = 0.01; });
  StepperTurntable table(ready(grbl_at(port)), options_with(0.0));
  start(table);
  std::stop_source stop;
  const std::jthread user([&] {
    EXPECT_TRUE(wait_until(
        [&] { return port.with<EmulatedGrbl>([](auto& grbl) { return grbl.moving(); }); }));
    stop.request_stop();
  });
  const std::string sentence =
      error_of([&] { table.move_to(1.0, Deadline::in(kPatience_s, stop.get_token())); });
  EXPECT_NE(sentence.find("stopped by the user"), std::string::npos) << sentence;
}

TEST_F(GrblTurntable, SwitchesLampsAndLasersOffAtTheEnd) {
  EmulatedPort port(std::make_unique<EmulatedGrbl>());
  {
    const auto board = ready(grbl_at(port));
    BoardSwitch laser(board, "M3 S1000", "M5");
    BoardSwitch lamp(board, "M8", "M9");
    laser.set(true, soon());
    lamp.set(true, soon());
    port.with<EmulatedGrbl>([](auto& grbl) { EXPECT_TRUE(grbl.spindle && grbl.coolant); });
  }
  port.with<EmulatedGrbl>([](auto& grbl) { EXPECT_FALSE(grbl.spindle || grbl.coolant); });
}

TEST_F(GrblTurntable, SwitchesTheLaserOffOnAFaultOfTheTable) {
  EmulatedPort port(std::make_unique<EmulatedGrbl>());
  const auto board = ready(grbl_at(port));
  StepperTurntable table(board, options_with(0.0));
  BoardSwitch laser(board, "M3 S1000", "M5");
  start(table);
  laser.set(true, soon());
  port.with<EmulatedGrbl>([](auto& grbl) { grbl.reset_in_next_move = true; });
  EXPECT_THROW(table.move_to(1.0, soon()), Error);
  EXPECT_FALSE(laser.is_on());
  port.with<EmulatedGrbl>([](auto& grbl) { EXPECT_FALSE(grbl.spindle); });
}

TEST_F(GrblTurntable, WritesStepsOnlyWhenDifferentAndLosesNoCommand) {
  EmulatedPort port(std::make_unique<EmulatedGrbl>());
  MotionControllerSettings settings = quick();
  settings.steps_per_unit = 88.889;
  for (int time = 0; time < 2; ++time) {
    const auto firmware = make_grbl(open_serial({port.path()}), settings);
    firmware->connect(soon());
    firmware->enable_motor(true, soon());
    firmware->command("M5", soon());
    firmware->stop();
  }
  port.with<EmulatedGrbl>([](auto& grbl) {
    EXPECT_NEAR(grbl.settings[100], 88.889, 1e-6);
    EXPECT_EQ(grbl.settings_written, 1);
  });
}

TEST_F(GrblTurntable, TakesTheSettingsOfARotaryAxis) {
  EmulatedPort port(std::make_unique<EmulatedGrbl>());
  port.with<EmulatedGrbl>([](auto& grbl) {
    grbl.axis = 'A';
    grbl.settings = {{20, 0}, {100, 250}, {103, 88.889}, {110, 500}, {113, 3000}, {123, 200}};
  });
  MotionControllerSettings settings = quick();
  settings.axis = 'A';
  settings.steps_per_unit = 88.889;
  const auto firmware = ready(make_grbl(open_serial({port.path()}), settings));
  firmware->enable_motor(true, soon());
  EXPECT_EQ(firmware->take_change(), "") << "$103 is right already";
  EXPECT_NEAR(firmware->move_time_s(100.0, 1000.0), 100.0 / 50.0 + 50.0 / 200.0, 1e-9);
  port.with<EmulatedGrbl>([](auto& grbl) {
    EXPECT_EQ(grbl.settings_written, 0);
    EXPECT_DOUBLE_EQ(grbl.settings[100], 250.0) << "of axis X";
    grbl.settings[103] = 44.4;
  });
  StepperTurntable table(firmware, options_with(0.0));
  static_cast<void>(table.test(soon()));
  const auto differing = table.take_warnings();
  ASSERT_EQ(differing.size(), 1U);
  EXPECT_EQ(differing[0], "its $103 is 44.4; a scan sets it to the 88.889 steps of the rig");
  port.with<EmulatedGrbl>([](auto& grbl) { EXPECT_EQ(grbl.settings_written, 0); });
  start(table);
  const auto changed = table.take_warnings();
  ASSERT_EQ(changed.size(), 1U);
  EXPECT_NE(changed[0].find("its $103 was 44.4 and is now 88.889"), std::string::npos);
  table.move_to(0.5, soon());
  port.with<EmulatedGrbl>([](auto& grbl) {
    EXPECT_NEAR(grbl.settings[103], 88.889, 1e-9);
    EXPECT_DOUBLE_EQ(grbl.settings[100], 250.0);
    EXPECT_NEAR(grbl.position(), deg_from_rad(0.5), 1e-3);
  });
}

TEST_F(GrblTurntable, NamesAnAxisThatTheBoardDoesNotHave) {
  EmulatedPort port(std::make_unique<EmulatedGrbl>());
  MotionControllerSettings settings = quick();
  settings.axis = 'A';
  settings.steps_per_unit = 88.889;
  const auto firmware = ready(make_grbl(open_serial({port.path()}), settings));
  EXPECT_NE(error_of([&] {
              firmware->enable_motor(true, soon());
            }).find("does not report its $103, the steps of axis A"),
            std::string::npos);
}

TEST_F(GrblTurntable, AcceptsTheGreetingsOfItsKin) {
  for (const char* version : {"GrblHAL 1.1f ['$' or '$HELP' for help]",
                              "Grbl 3.7 [FluidNC v3.7.10 (wifi) '$' for help]",
                              "Grbl 1.3a ['$' for help]"}) {
    auto board = std::make_unique<EmulatedGrbl>();
    board->version = version;
    EmulatedPort port(std::move(board));
    const auto firmware = ready(grbl_at(port));
    EXPECT_NE(firmware->identify(soon()).find("Idle"), std::string::npos) << version;
    firmware->enable_motor(true, soon());
    port.with<EmulatedGrbl>([](auto& grbl) { grbl.reset_in_next_move = true; });
    const std::string fault = error_of([&] { firmware->move_to(5.0, 10.0, soon()); });
    EXPECT_NE(fault.find("it was reset while it moved"), std::string::npos)
        << version << ": " << fault;
  }
}

TEST_F(GrblTurntable, ConnectingAndIdentifyingWriteNothingToTheBoard) {
  EmulatedPort port(std::make_unique<EmulatedGrbl>());
  MotionControllerSettings settings = quick();
  settings.steps_per_unit = 88.889;
  const auto firmware = make_grbl(open_serial({port.path()}), settings);
  firmware->connect(soon());
  EXPECT_NE(firmware->identify(soon()).find("Idle"), std::string::npos);
  port.with<EmulatedGrbl>([](auto& grbl) {
    EXPECT_EQ(grbl.settings_written, 0);
    EXPECT_DOUBLE_EQ(grbl.settings[100], 250.0);
  });
}

TEST_F(GrblTurntable, AsksForHomingOfALockedBoard) {
  EmulatedPort port(std::make_unique<EmulatedGrbl>());
  const auto firmware = grbl_at(port);
  firmware->connect(soon());
  port.with<EmulatedGrbl>([](auto& grbl) { grbl.alarm = true; });
  EXPECT_NE(error_of([&] { firmware->command("G1 X1 F100", soon()); }).find("error:9"),
            std::string::npos);
}

TEST_F(GrblTurntable, ReportsSilenceAndGarbageByTheDeadline) {
  for (const bool garbage : {false, true}) {
    auto board = std::make_unique<EmulatedGrbl>();
    board->silent = !garbage;
    board->garbage = garbage;
    EmulatedPort port(std::move(board));
    const auto firmware = grbl_at(port);
    const std::string sentence = error_of([&] { firmware->connect(Deadline::in(0.6)); });
    EXPECT_EQ(sentence.find(port.path()), 0U) << sentence;
    EXPECT_NE(sentence.find(garbage ? "does not run GRBL" : "no greeting"), std::string::npos);
  }
}

TEST_F(MarlinTurntable, WaitsWhileBusyAndRepeatsBrokenLines) {
  EmulatedPort port(std::make_unique<EmulatedMarlin>());
  StepperTurntable table(ready(make_marlin(open_serial({port.path()}), quick())),
                         options_with(0.0));
  start(table);
  port.with<EmulatedMarlin>([](auto& marlin) { marlin.lines_to_break = 2; });
  table.move_to(rad_from_deg(90.0), soon());
  port.with<EmulatedMarlin>([](auto& marlin) {
    EXPECT_DOUBLE_EQ(marlin.position, 90.0);
    EXPECT_EQ(marlin.commands.back(), "M400");
  });
}

TEST_F(MarlinTurntable, LosesTheAngleWhenTheBoardHalts) {
  EmulatedPort port(std::make_unique<EmulatedMarlin>());
  StepperTurntable table(ready(make_marlin(open_serial({port.path()}), quick())),
                         options_with(0.0));
  start(table);
  port.with<EmulatedMarlin>([](auto& marlin) { marlin.kill_in_next_move = true; });
  EXPECT_NE(error_of([&] { table.move_to(1.0, soon()); }).find("halted"), std::string::npos);
  EXPECT_FALSE(table.angle_rad().has_value());
}

TEST_F(MarlinTurntable, GivesUpALineThatNeverArrivesIntact) {
  EmulatedPort port(std::make_unique<EmulatedMarlin>());
  const auto firmware = make_marlin(open_serial({port.path()}), quick());
  firmware->connect(soon());
  port.with<EmulatedMarlin>([](auto& marlin) { marlin.lines_to_break = 100; });
  EXPECT_NE(error_of([&] { firmware->command("M5", soon()); }).find("again"), std::string::npos);
}

TEST_F(HorusTurntable, TurnsAndSwitchesLasersOff) {
  EmulatedPort port(std::make_unique<EmulatedHorus>());
  {
    const auto board = ready(make_horus(open_serial({port.path()}), quick()));
    StepperTurntable table(board, options_with(0.0));
    port.with<EmulatedHorus>([](auto& horus) { EXPECT_FALSE(horus.lasers[0] || horus.lasers[1]); });
    start(table);
    const auto begun = Deadline::Clock::now();
    table.move_to(rad_from_deg(-9.0), soon());
    EXPECT_GE(Deadline::Clock::now() - begun, std::chrono::milliseconds(100))
        << "the duration of the move, which the board does not report";
    board->command("M71T1", soon());
    port.with<EmulatedHorus>([](auto& horus) { EXPECT_DOUBLE_EQ(horus.position, -9.0); });
  }
  EXPECT_TRUE(wait_until([&] {
    return port.with<EmulatedHorus>([](auto& horus) { return !horus.lasers[0] && !horus.motor; });
  }));
}

TEST_F(HorusTurntable, NamesAnotherFirmware) {
  auto board = std::make_unique<EmulatedHorus>();
  board->version = "Horus 0.1 ['$' for help]";
  EmulatedPort port(std::move(board));
  const auto firmware = make_horus(open_serial({port.path()}), quick());
  EXPECT_NE(error_of([&] { firmware->connect(Deadline::in(0.5)); }).find("Horus 0.2"),
            std::string::npos);
}

}  // namespace
}  // namespace frangia
