#include "frangia/devices/hardware_drivers.h"

#include <fstream>

#include <gtest/gtest.h>

#include "frangia/devices/rig_devices.h"

#include "support/emulated_boards.h"
#include "support/emulated_grbl.h"
#include "support/error_of.h"
#include "support/pseudo_terminal_test.h"
#include "support/soon.h"
#include "support/temporary_folder.h"
#include "support/wait_until.h"

namespace frangia {
namespace {

using testing::EmulatedGrbl;
using testing::EmulatedPort;
using testing::EmulatedScpi;
using testing::error_of;
using testing::soon;
using testing::wait_until;

class HardwareDrivers : public testing::PseudoTerminalTest {
 protected:
  [[nodiscard]] RigDevices open(const std::string& devices, const Deadline& deadline = soon()) {
    const auto file = folder_.path() / "rig.toml";
    std::ofstream(file) << "format = \"frangia-rig\"\nversion = 1\n" << devices;
    return open_devices(file, Rig{}, hardware_drivers(), deadline);
  }

 private:
  testing::TemporaryFolder folder_;
};

TEST_F(HardwareDrivers, ATurntableAndALaserShareTheirBoard) {
  EmulatedPort port(std::make_unique<EmulatedGrbl>());
  const std::string line = "driver = \"grbl\"\nport = \"" + port.path() + "\"\nboot_s = 0.3\n";
  RigDevices devices = open("[devices.light]\n" + line + "[devices.line]\n" + line +
                            "on = \"M8\"\noff = \"M9\"\n[devices.turntable]\n" + line +
                            "backlash_deg = 1.0\nmin_deg = -10\nmax_deg = 370\n");
  const Deadline deadline = soon();
  devices.light->set(true, deadline);
  devices.turntable->enable(true, deadline);
  devices.turntable->home(deadline);
  devices.turntable->move_to(0.5, deadline);
  devices.laser_sheet->set(true, deadline);
  port.with<EmulatedGrbl>([](auto& grbl) { EXPECT_TRUE(grbl.spindle && grbl.coolant); });
  devices.light->set(false, deadline);
  EXPECT_NEAR(devices.turntable->angle_rad().value(), 0.5, 1e-12);
  devices.make_safe();
  port.with<EmulatedGrbl>([](auto& grbl) { EXPECT_FALSE(grbl.spindle || grbl.coolant); });
}

TEST_F(HardwareDrivers, ATableDrivesItsAxisOfABoardThatALampOpenedFirst) {
  EmulatedPort port(std::make_unique<EmulatedGrbl>());
  port.with<EmulatedGrbl>([](auto& grbl) {
    grbl.axis = 'A';
    grbl.settings = {{20, 0}, {100, 250}, {103, 250}};
  });
  const std::string line = "driver = \"grbl\"\nport = \"" + port.path() + "\"\nboot_s = 0.3\n";
  RigDevices devices = open("[devices.light]\n" + line + "[devices.turntable]\n" + line +
                            "axis = \"A\"\nsteps_per_degree = 88.889\n");
  const Deadline deadline = Deadline::in(3.0);
  devices.turntable->enable(true, deadline);
  devices.turntable->home(deadline);
  devices.turntable->move_to(0.5, deadline);
  port.with<EmulatedGrbl>([](auto& grbl) {
    EXPECT_NEAR(grbl.position(), 0.5 * 180.0 / 3.14159265358979, 1e-3);
    EXPECT_DOUBLE_EQ(grbl.settings[100], 250.0);
    EXPECT_NEAR(grbl.settings[103], 88.889, 1e-6);
  });
}

TEST_F(HardwareDrivers, AMissingPortIsNamed) {
  const std::string sentence = error_of([&] {
    static_cast<void>(open("[devices.turntable]\ndriver = \"marlin\"\nport = \"/dev/x\"\n"));
  });
  EXPECT_EQ(sentence.find("/dev/x: cannot be opened"), 0U) << sentence;
}

TEST_F(HardwareDrivers, ALightWithCustomCommandsIsOffWhenOpenedAndAtTheEnd) {
  EmulatedPort port(std::make_unique<EmulatedScpi>(), EmulatedPort::Kind::Tcp);
  port.with<EmulatedScpi>([](auto& supply) { supply.output = true; });
  {
    RigDevices devices = open(
        "[devices.light]\ndriver = \"commands\"\nhost = \"127.0.0.1\"\n"
        "tcp_port = " +
        std::to_string(port.tcp_port()) +
        "\non = [\"OUTP ON\"]\noff = [\"OUTP OFF\"]\n"
        "error_query = \"SYST:ERR?\"\nno_error = \"0\"\n");
    port.with<EmulatedScpi>([](auto& supply) { EXPECT_FALSE(supply.output); });
    devices.light->set(true, soon());
    port.with<EmulatedScpi>([](auto& supply) { EXPECT_TRUE(supply.output); });
  }
  EXPECT_TRUE(wait_until(
      [&] { return port.with<EmulatedScpi>([](auto& supply) { return !supply.output; }); }));
}

TEST_F(HardwareDrivers, AMissingKeyIsNamed) {
  EXPECT_NE(
      error_of([&] {
        static_cast<void>(open("[devices.fringes]\ndriver = \"commands\"\nport = \"/dev/x\"\n"));
      }).find("devices.fringes.set"),
      std::string::npos);
}

}  // namespace
}  // namespace frangia
