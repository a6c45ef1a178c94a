#include "frangia/devices/device_settings.h"

#include <fstream>

#include <gtest/gtest.h>

#include "frangia/core/error.h"
#include "frangia/devices/driver_registry.h"

#include "support/temporary_folder.h"

namespace frangia {
namespace {

std::vector<DeviceSettings> read(const std::string& devices) {
  const testing::TemporaryFolder folder;
  const auto path = folder.path() / "rig.toml";
  std::ofstream(path) << "format = \"frangia-rig\"\nversion = 1\n" << devices;
  return read_device_settings(path);
}

std::string complaint(const std::string& devices) {
  try {
    static_cast<void>(open_devices(read(devices), {}, {}));
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(DeviceSettings, EachKeyIsReadByItsType) {
  const auto all = read(
      "[devices.turntable]\ndriver = \"grbl\"\nport = \"/dev/ttyUSB0\"\nbaud = 115200\n"
      "steps_per_deg = 8.5\nreverse = true\nlimits_deg = [-10, 370.5]\nstart = [\"$X\"]\n");
  ASSERT_EQ(all.size(), 1U);
  const DeviceSettings& table = all.front();
  EXPECT_EQ(table.role(), "turntable");
  EXPECT_EQ(table.driver(), "grbl");
  EXPECT_EQ(table.device_name(), "turntable (grbl)");
  EXPECT_EQ(table.text("port"), "/dev/ttyUSB0");
  EXPECT_EQ(table.integer_or("baud", 9600), 115200);
  EXPECT_EQ(table.number("steps_per_deg"), 8.5);
  EXPECT_TRUE(table.flag_or("reverse", false));
  EXPECT_EQ(table.numbers("limits_deg"), (std::vector<double>{-10.0, 370.5}));
  EXPECT_EQ(table.texts("start"), std::vector<std::string>{"$X"});
  EXPECT_EQ(table.number_or("backlash_deg", 1.5), 1.5);
}

TEST(DeviceSettings, KeyThatNoOneAskedForIsWarnedOf) {
  const auto all = read("[devices.camera]\ndriver = \"v4l2\"\nexposure = 3\n");
  std::vector<std::string> warnings;
  frangia::Run run;
  run.on_warning = [&](const std::string& sentence) { warnings.push_back(sentence); };
  all.front().warn_of_the_rest(run);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings.front().find("devices.camera.exposure"), std::string::npos);
}

TEST(DeviceSettings, WrongTypeNamesTheKey) {
  const auto all = read("[devices.camera]\ndriver = \"v4l2\"\ngain_db = \"much\"\n");
  try {
    static_cast<void>(all.front().number("gain_db"));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::Input);
    EXPECT_NE(std::string(error.what()).find("devices.camera.gain_db"), std::string::npos);
  }
}

TEST(DeviceSettings, UnknownDriverAndRoleAreNamed) {
  EXPECT_NE(complaint("[devices.camera]\ndriver = \"webkam\"\n").find("\"webkam\""),
            std::string::npos);
  EXPECT_NE(complaint("[devices.cammera]\ndriver = \"v4l2\"\n").find("devices.cammera"),
            std::string::npos);
  EXPECT_NE(complaint("[devices.camera]\nport = 3\n").find("devices.camera.driver is missing"),
            std::string::npos);
}

}  // namespace
}  // namespace frangia
