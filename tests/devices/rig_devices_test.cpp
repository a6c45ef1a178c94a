#include "frangia/devices/rig_devices.h"

#include <fstream>

#include <gtest/gtest.h>

#include "support/temporary_folder.h"

namespace frangia {
namespace {

/// A switch whose state the test can read.
class TestSwitch : public SwitchDevice {
 public:
  explicit TestSwitch(bool* on) : on_(on) {}
  [[nodiscard]] std::string name() const override { return "test switch"; }
  [[nodiscard]] std::string test(const Deadline& /*deadline*/) override { return "works"; }
  void make_safe() noexcept override { *on_ = false; }
  void set(bool on, const Deadline& /*deadline*/) override { *on_ = on; }
  [[nodiscard]] bool is_on() const override { return *on_; }

 private:
  bool* on_;
};

std::vector<Driver> switch_drivers(DeviceKind kind, bool* on) {
  Driver driver;
  driver.name = "test";
  driver.kind = kind;
  driver.open = [on](DeviceSettings&, const Rig&, const Deadline&) -> std::unique_ptr<Device> {
    return std::make_unique<TestSwitch>(on);
  };
  return {driver};
}

class OpenDevices : public ::testing::Test {
 protected:
  [[nodiscard]] RigDevices open(const std::string& devices, const std::vector<Driver>& drivers) {
    const auto file = folder_.path() / "rig.toml";
    std::ofstream(file) << "format = \"frangia-rig\"\nversion = 1\n" << devices;
    return open_devices(file, Rig{}, drivers, Deadline::in(1.0));
  }
  [[nodiscard]] std::string fault(const std::string& devices, const std::vector<Driver>& drivers) {
    try {
      static_cast<void>(open(devices, drivers));
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  }

 private:
  testing::TemporaryFolder folder_;
};

TEST_F(OpenDevices, AreDarkAfterDestruction) {
  bool on = false;
  {
    const RigDevices devices =
        open("[devices.light]\ndriver = \"test\"\n", switch_drivers(DeviceKind::Light, &on));
    ASSERT_TRUE(devices.light);
    devices.light->set(true, Deadline::in(1.0));
    EXPECT_TRUE(on);
  }
  EXPECT_FALSE(on);
}

TEST_F(OpenDevices, NamesAnUnknownDriverAndTheAvailableOnes) {
  bool on = false;
  const std::string sentence =
      fault("[devices.light]\ndriver = \"torch\"\n", switch_drivers(DeviceKind::Light, &on));
  EXPECT_NE(sentence.find("devices.light.driver is \"torch\""), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("are test"), std::string::npos) << sentence;
}

TEST_F(OpenDevices, RefusesADeviceOfAnotherKindThanItsDriver) {
  bool on = false;
  const std::string sentence =
      fault("[devices.turntable]\ndriver = \"test\"\n", switch_drivers(DeviceKind::Turntable, &on));
  EXPECT_NE(sentence.find("another kind"), std::string::npos) << sentence;
}

}  // namespace
}  // namespace frangia
