#include <gtest/gtest.h>

#include "frangia/devices/internal/message_instrument.h"
#include "frangia/devices/internal/open_transport.h"

#include "support/emulated_boards.h"
#include "support/error_of.h"
#include "support/pseudo_terminal_test.h"
#include "support/soon.h"
#include "support/wait_until.h"

namespace frangia {
namespace {

using testing::EmulatedGcs2;
using testing::EmulatedPort;
using testing::EmulatedPrologix;
using testing::EmulatedScpi;
using testing::error_of;
using testing::soon;
using testing::wait_until;

class ScpiShifter : public testing::PseudoTerminalTest {};
class PrologixShifter : public testing::PseudoTerminalTest {};
class Gcs2Shifter : public testing::PseudoTerminalTest {};

ShifterInfo up_to(double most) {
  ShifterInfo info;
  info.max_command = most;
  info.curve = {{0.0, most}, {0.0, 7.0}};
  return info;
}

InstrumentShifter shifter_at(const EmulatedPort& port,
                             const ActuatorProtocol& protocol,
                             double most) {
  return {open_serial({port.path()}), protocol, up_to(most), 0.0, soon()};
}

TEST_F(ScpiShifter, SetsItsCommandsAndSwitchesTheOutputOffAtTheEnd) {
  EmulatedPort port(std::make_unique<EmulatedScpi>(), EmulatedPort::Kind::Tcp);
  {
    InstrumentShifter piezo(
        open_tcp("127.0.0.1", port.tcp_port(), soon()), scpi_protocol(), up_to(4.0), 0.0, soon());
    EXPECT_EQ(piezo.test(soon()), "Frangia,Emulated generator,0,1");
    piezo.drive(1.5, soon());
    piezo.drive(0.25, soon());
    port.with<EmulatedScpi>([](auto& generator) {
      EXPECT_TRUE(generator.output);
      EXPECT_EQ(generator.set, (std::vector<double>{1.5, 0.25}));
    });
  }
  EXPECT_TRUE(wait_until(
      [&] { return port.with<EmulatedScpi>([](auto& generator) { return !generator.output; }); }));
}

TEST_F(ScpiShifter, SendsNothingOutsideItsRange) {
  EmulatedPort port(std::make_unique<EmulatedScpi>());
  InstrumentShifter piezo = shifter_at(port, scpi_protocol(), 4.0);
  const std::string sentence = error_of([&] { piezo.drive(4.5, soon()); });
  EXPECT_NE(sentence.find("outside its range, 0 to 4"), std::string::npos) << sentence;
  port.with<EmulatedScpi>([](auto& generator) { EXPECT_TRUE(generator.set.empty()); });
}

TEST_F(ScpiShifter, ReportsTheErrorOfTheInstrumentWithTheCommand) {
  EmulatedPort port(std::make_unique<EmulatedScpi>());
  InstrumentShifter piezo = shifter_at(port, scpi_protocol(), 10.0);
  const std::string sentence = error_of([&] { piezo.drive(9.0, soon()); });
  EXPECT_NE(sentence.find("Data out of range"), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("VOLT:OFFS 9"), std::string::npos) << sentence;
}

TEST_F(ScpiShifter, FailsAtTheDeadlineWhenSilentOrUnsettled) {
  for (const bool silent : {true, false}) {
    EmulatedPort port(std::make_unique<EmulatedScpi>());
    InstrumentShifter piezo = shifter_at(port, scpi_protocol(), 4.0);
    piezo.drive(0.5, soon());  // the output is on
    port.with<EmulatedScpi>([&](auto& generator) {
      generator.silent = silent;
      generator.never_settles = true;
    });
    const std::string sentence = error_of([&] { piezo.drive(1.0, Deadline::in(0.5)); });
    EXPECT_NE(sentence.find(silent ? "no answer within 0.5 s" : "not settled within 0.5 s"),
              std::string::npos)
        << sentence;
  }
}

TEST_F(Gcs2Shifter, ReturnsFromAMoveOnTarget) {
  EmulatedPort port(std::make_unique<EmulatedGcs2>());
  InstrumentShifter stage = shifter_at(port, gcs2_protocol(), 200.0);
  stage.drive(12.5, soon());
  port.with<EmulatedGcs2>([](auto& controller) {
    EXPECT_DOUBLE_EQ(controller.target, 12.5);
    EXPECT_EQ(controller.answer("ONT? 1"), "1=1\n");
  });
  EXPECT_NE(error_of([&] { stage.drive(150.0, soon()); }).find("reports 7"), std::string::npos);
}

TEST_F(Gcs2Shifter, MovesAgainAfterAStop) {
  EmulatedPort port(std::make_unique<EmulatedGcs2>());
  InstrumentShifter stage = shifter_at(port, gcs2_protocol(), 80.0);
  stage.drive(12.5, soon());
  stage.make_safe();
  stage.drive(20.0, soon());
  port.with<EmulatedGcs2>([](auto& controller) { EXPECT_DOUBLE_EQ(controller.target, 20.0); });
}

TEST_F(ScpiShifter, SwitchesTheOutputOnWithItsFirstValueOnly) {
  EmulatedPort port(std::make_unique<EmulatedScpi>());
  InstrumentShifter piezo = shifter_at(port, scpi_protocol(), 4.0);
  port.with<EmulatedScpi>([](auto& generator) { EXPECT_FALSE(generator.output); });
  piezo.drive(1.0, soon());
  port.with<EmulatedScpi>([](auto& generator) { EXPECT_TRUE(generator.output); });
}

TEST_F(PrologixShifter, AnInstrumentOnGpibWorksAsOnItsOwnLine) {
  EmulatedPort port(std::make_unique<EmulatedPrologix>(std::make_unique<EmulatedScpi>(), 9),
                    EmulatedPort::Kind::Tcp);
  InstrumentShifter piezo(open_prologix(open_tcp("127.0.0.1", port.tcp_port(), soon()), 9, soon()),
                          scpi_protocol(),
                          up_to(4.0),
                          0.0,
                          soon());
  piezo.drive(1.25, soon());
  port.with<EmulatedPrologix>([](auto& adapter) {
    EXPECT_DOUBLE_EQ(dynamic_cast<EmulatedScpi&>(adapter.instrument()).volts, 1.25);
  });
}

TEST_F(PrologixShifter, AnUnusedAddressAndAMissingAdapterAreNamed) {
  EmulatedPort port(std::make_unique<EmulatedPrologix>(std::make_unique<EmulatedScpi>(), 9),
                    EmulatedPort::Kind::Tcp);
  const std::string sentence = error_of([&] {
    const InstrumentShifter nobody(
        open_prologix(open_tcp("127.0.0.1", port.tcp_port(), soon()), 8, soon()),
        scpi_protocol(),
        up_to(4.0),
        0.0,
        Deadline::in(0.2));
  });
  EXPECT_NE(sentence.find("GPIB 8: no answer"), std::string::npos) << sentence;
  EmulatedPort other(std::make_unique<EmulatedGcs2>());
  EXPECT_THROW(static_cast<void>(open_prologix(open_serial({other.path()}), 9, Deadline::in(0.2))),
               Error);
}

TEST(ActuatorProtocol, FillsACustomCommandAndNamesAnInvalidOne) {
  EXPECT_EQ(fill_command("1 VOLT {value:.2f}", 3.14159), "1 VOLT 3.14");
  EXPECT_NE(error_of([] { static_cast<void>(fill_command("VOLT", 1.0)); }).find("has no {value}"),
            std::string::npos);
  EXPECT_NE(error_of([] { static_cast<void>(fill_command("V {value:q}", 1.0)); }).find("filled"),
            std::string::npos);
}

}  // namespace
}  // namespace frangia
