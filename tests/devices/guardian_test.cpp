#include "frangia/devices/guardian.h"

#include <array>
#include <cstring>
#include <fstream>

#include <gtest/gtest.h>
#include <sys/socket.h>

#include "frangia/devices/hardware_drivers.h"
#include "frangia/devices/internal/guardian_message.h"
#include "frangia/devices/rig_devices.h"

#include "support/emulated_boards.h"
#include "support/emulated_grbl.h"
#include "support/error_of.h"
#include "support/misbehaving_device.h"
#include "support/pseudo_terminal_test.h"
#include "support/soon.h"
#include "support/temporary_folder.h"
#include "support/wait_until.h"

namespace frangia {
namespace {

using testing::EmulatedGrbl;
using testing::EmulatedHorus;
using testing::EmulatedMarlin;
using testing::EmulatedPort;
using testing::EmulatedPrologix;
using testing::EmulatedScpi;
using testing::error_of;
using testing::MisbehavingDevice;
using testing::soon;
using testing::wait_until;

/// The work of the guardian process on a thread of the test.
class GuardianThread {
 public:
  GuardianThread() {
    EXPECT_EQ(::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends_.data()), 0);
    thread_ = std::jthread([this] { EXPECT_EQ(run_guardian(ends_[1]), 0); });
    char ready = 0;
    EXPECT_EQ(::recv(ends_[0], &ready, 1, 0), 1);
  }
  GuardianThread(const GuardianThread&) = delete;
  GuardianThread& operator=(const GuardianThread&) = delete;
  GuardianThread(GuardianThread&&) = delete;
  GuardianThread& operator=(GuardianThread&&) = delete;
  ~GuardianThread() {
    end();
    ::close(ends_[1]);
  }
  void watch(const SafeOff& how) const {
    send({GuardianMessageKind::Watch,
          how.file,
          how.pause_s,
          static_cast<std::uint32_t>(how.end_command.size()),
          static_cast<std::uint32_t>(how.off.size())},
         how.end_command + how.off,
         how.file);
  }
  void send(const GuardianMessage& message, const std::string& text = {}, int file = -1) const {
    std::string packet(sizeof(message), '\0');
    std::memcpy(packet.data(), &message, sizeof(message));
    packet += text;
    iovec data{packet.data(), packet.size()};
    msghdr header{};
    header.msg_iov = &data;
    header.msg_iovlen = 1;
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> control{};
    if (file >= 0) {
      header.msg_control = control.data();
      header.msg_controllen = control.size();
      cmsghdr* rights = CMSG_FIRSTHDR(&header);
      rights->cmsg_level = SOL_SOCKET;
      rights->cmsg_type = SCM_RIGHTS;
      rights->cmsg_len = CMSG_LEN(sizeof(int));
      std::memcpy(CMSG_DATA(rights), &file, sizeof(int));
    }
    EXPECT_EQ(::sendmsg(ends_[0], &header, 0), static_cast<ssize_t>(packet.size()));
  }
  /// Breaks the connection, as the death of the program does.
  void die() {
    if (ends_[0] >= 0) ::close(std::exchange(ends_[0], -1));
  }
  /// The same, and waits until the guardian has done its work.
  void end() {
    die();
    if (thread_.joinable()) thread_.join();
  }

 private:
  std::array<int, 2> ends_ = {-1, -1};
  std::jthread thread_;
};

class GuardianOf : public testing::PseudoTerminalTest {
 protected:
  [[nodiscard]] RigDevices open(const std::string& light, Guardian* guardian = nullptr) {
    const auto file = folder_.path() / "rig.toml";
    std::ofstream(file) << "format = \"frangia-rig\"\nversion = 1\n[devices.light]\n" << light;
    return open_devices(file, Rig{}, hardware_drivers(), soon(), {}, guardian);
  }
  /// Switches a light on, sends a part of a command and lets the program die: `is_dark` after it.
  template <typename IsDark>
  void expect_dark(const std::string& light, const std::string& part, const IsDark& is_dark) {
    RigDevices devices = open(light);
    GuardianThread guardian;
    const auto how = devices.light->safe_off();
    ASSERT_TRUE(how);
    guardian.watch(*how);
    devices.light->set(true, soon());
    ASSERT_TRUE(wait_until([&] { return !is_dark(); }));
    EXPECT_EQ(::write(how->file, part.data(), part.size()), static_cast<ssize_t>(part.size()));
    guardian.die();
    EXPECT_TRUE(wait_until(is_dark));
  }

  testing::TemporaryFolder folder_;
};

TEST_F(GuardianOf, GrblSwitchesOffAfterAHalfWrittenCommand) {
  EmulatedPort port(std::make_unique<EmulatedGrbl>());
  const auto is_dark = [&] {
    return port.with<EmulatedGrbl>([](auto& grbl) { return !grbl.spindle && !grbl.coolant; });
  };
  const std::string board = "driver = \"grbl\"\nboot_s = 0.3\n" + port.settings();
  expect_dark(board, "G21 G90 G1 X1", is_dark);
}

TEST_F(GuardianOf, MarlinSwitchesOffACustomOutputAfterAHalfWrittenCommand) {
  EmulatedPort port(std::make_unique<EmulatedMarlin>());
  const auto is_dark = [&] {
    return port.with<EmulatedMarlin>([](auto& marlin) { return !marlin.pin; });
  };
  const std::string board =
      "driver = \"marlin\"\nboot_s = 0.3\non = \"M42 P4 S255\"\n"
      "off = \"M42 P4 S0\"\n" +
      port.settings();
  expect_dark(board, "N9 G1 X", is_dark);
}

TEST_F(GuardianOf, HorusSwitchesItsLaserOff) {
  EmulatedPort port(std::make_unique<EmulatedHorus>());
  const auto is_dark = [&] {
    return port.with<EmulatedHorus>([](auto& horus) { return !horus.lasers[0]; });
  };
  const std::string board = "driver = \"horus\"\nboot_s = 0.3\n" + port.settings();
  expect_dark(board, "G1X", is_dark);
}

TEST_F(GuardianOf, AnInstrumentOnTheNetworkSwitchesOffAfterAHalfWrittenCommand) {
  EmulatedPort port(std::make_unique<EmulatedScpi>(), EmulatedPort::Kind::Tcp);
  const auto is_dark = [&] {
    return port.with<EmulatedScpi>([](auto& supply) { return !supply.output; });
  };
  expect_dark("driver = \"scpi\"\n" + port.settings(), "VOLT:OF", is_dark);
}

TEST_F(GuardianOf, AnInstrumentOnGpibSwitchesOffAfterAHalfWrittenCommand) {
  EmulatedPort port(std::make_unique<EmulatedPrologix>(std::make_unique<EmulatedScpi>(), 9),
                    EmulatedPort::Kind::Tcp);
  const auto is_dark = [&] {
    return port.with<EmulatedPrologix>(
        [](auto& adapter) { return !dynamic_cast<EmulatedScpi&>(adapter.instrument()).output; });
  };
  const std::string light = "driver = \"scpi\"\ngpib_address = 9\n" + port.settings();
  expect_dark(light, "VOLT\x1b", is_dark);
}

TEST_F(GuardianOf, AChatteringBoardSwitchesOff) {
  EmulatedPort port(std::make_unique<MisbehavingDevice>(std::make_unique<EmulatedGrbl>()));
  const auto is_dark = [&] {
    return port.with<MisbehavingDevice>(
        [](auto& device) { return !device.template inner<EmulatedGrbl>().spindle; });
  };
  RigDevices devices = open("driver = \"grbl\"\nboot_s = 0.3\n" + port.settings());
  GuardianThread guardian;
  guardian.watch(*devices.light->safe_off());
  devices.light->set(true, soon());
  port.with<MisbehavingDevice>([](auto& device) { device.flood = true; });
  guardian.die();
  EXPECT_TRUE(wait_until(is_dark));
  port.with<MisbehavingDevice>([](auto& device) { device.flood = false; });
}

TEST_F(GuardianOf, AReleasedLineAndAFarewellSwitchNothingOff) {
  EmulatedPort port(std::make_unique<EmulatedScpi>(), EmulatedPort::Kind::Tcp);
  RigDevices devices = open("driver = \"scpi\"\n" + port.settings());
  const auto how = devices.light->safe_off();
  ASSERT_TRUE(how);
  for (const auto kind : {GuardianMessageKind::Release, GuardianMessageKind::Farewell}) {
    GuardianThread guardian;
    guardian.watch(*how);
    devices.light->set(true, soon());
    guardian.send({kind, how->file});
    guardian.end();
    EXPECT_TRUE(wait_until([&] { return port.has_received_all(); }));
    port.with<EmulatedScpi>([](auto& supply) { EXPECT_TRUE(supply.output); });
  }
}

TEST_F(GuardianOf, AProgramThatEndsWellIsGoneWithItsProcess) {
  EmulatedPort port(std::make_unique<EmulatedGrbl>());
  const std::string board = "driver = \"grbl\"\nboot_s = 0.3\n" + port.settings();
  {
    Guardian guardian({FRANGIA_PROGRAM, {"frangia", "guardian"}});
    const RigDevices devices = open(board, &guardian);
    EXPECT_EQ(devices.watches.size(), 1U);
  }
  // The process held the lock of the port.
  EXPECT_NO_THROW(static_cast<void>(open(board)));
}

TEST_F(GuardianOf, AMissingProgramIsNamedAndTheDevicesStayClosed) {
  EmulatedPort port(std::make_unique<EmulatedGrbl>());
  Guardian guardian({"/nowhere/frangia", {"frangia", "guardian"}});
  const std::string sentence = error_of([&] {
    static_cast<void>(open("driver = \"grbl\"\nboot_s = 0.3\n" + port.settings(), &guardian));
  });
  EXPECT_NE(sentence.find("cannot be started from /nowhere/frangia"), std::string::npos)
      << sentence;
}

TEST_F(GuardianOf, AProgramThatIsNoGuardianIsNamed) {
  EmulatedPort port(std::make_unique<EmulatedGrbl>());
  Guardian guardian({"/bin/true", {"true"}});
  const std::string sentence = error_of([&] {
    static_cast<void>(open("driver = \"grbl\"\nboot_s = 0.3\n" + port.settings(), &guardian));
  });
  EXPECT_NE(sentence.find("does not start; check /bin/true"), std::string::npos) << sentence;
}

}  // namespace
}  // namespace frangia
