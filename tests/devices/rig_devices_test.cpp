#include "frangia/devices/rig_devices.h"

#include <array>
#include <atomic>
#include <fstream>
#include <memory>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "support/temporary_folder.h"
#include "support/wait_until.h"

namespace frangia {
namespace {

/// A switch whose state the test can read.
class TestSwitch : public SwitchDevice {
 public:
  explicit TestSwitch(std::atomic<bool>* on) : on_(on) {}
  [[nodiscard]] std::string name() const override { return "test switch"; }
  [[nodiscard]] std::string test(const Deadline& /*deadline*/) override { return "works"; }
  void make_safe() noexcept override { *on_ = false; }
  void set(bool on, const Deadline& /*deadline*/) override { *on_ = on; }
  [[nodiscard]] bool is_on() const override { return *on_; }

 private:
  std::atomic<bool>* on_;
};

std::vector<Driver> switch_drivers(DeviceKind kind, std::atomic<bool>* on) {
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
  std::atomic<bool> on = false;
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
  std::atomic<bool> on = false;
  const std::string sentence =
      fault("[devices.light]\ndriver = \"torch\"\n", switch_drivers(DeviceKind::Light, &on));
  EXPECT_NE(sentence.find("devices.light.driver is \"torch\""), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("are test"), std::string::npos) << sentence;
}

TEST_F(OpenDevices, RefusesADeviceOfAnotherKindThanItsDriver) {
  std::atomic<bool> on = false;
  const std::string sentence =
      fault("[devices.turntable]\ndriver = \"test\"\n", switch_drivers(DeviceKind::Turntable, &on));
  EXPECT_NE(sentence.find("another kind"), std::string::npos) << sentence;
}

/// A camera that hangs while it is made safe, until it is released.
class HangingCamera final : public CameraDevice {
 public:
  explicit HangingCamera(const std::atomic<bool>* released) : released_(released) {}
  [[nodiscard]] std::string name() const override { return "hanging camera"; }
  [[nodiscard]] std::string test(const Deadline& /*deadline*/) override { return "works"; }
  void make_safe() noexcept override { released_->wait(false); }
  [[nodiscard]] const CameraInfo& info() const override { return info_; }
  CameraSettings configure(const CameraSettings& settings, const Deadline& /*at*/) override {
    return settings;
  }
  [[nodiscard]] CapturedFrame capture(const FrameLabel& /*label*/,
                                      const Deadline& /*deadline*/) override {
    return {};
  }

 private:
  const std::atomic<bool>* released_;
  CameraInfo info_;
};

TEST(MakeSafe, ADeviceThatHangsKeepsNoOtherOn) {
  std::atomic<bool> on = true;
  std::atomic<bool> released = false;
  HangingCamera camera(&released);
  TestSwitch light(&on);
  const std::array<Device*, 2> devices = {&camera, &light};
  std::jthread safe([&] { make_safe(devices); });
  EXPECT_TRUE(testing::wait_until([&] { return !light.is_on(); }));
  released = true;
  released.notify_all();
}

TEST(MakeSafe, SwitchesMoreDevicesOffThanARigHas) {
  std::array<std::atomic<bool>, 12> on;
  std::vector<std::unique_ptr<TestSwitch>> lights;
  std::vector<Device*> devices;
  for (std::atomic<bool>& state : on) {
    state = true;
    lights.push_back(std::make_unique<TestSwitch>(&state));
    devices.push_back(lights.back().get());
  }
  make_safe(devices);
  for (const std::atomic<bool>& state : on)
    EXPECT_FALSE(state);
}

}  // namespace
}  // namespace frangia
