#include "frangia/devices/device_settings.h"

#include <fstream>
#include <functional>

#include <gtest/gtest.h>

#include "frangia/core/error.h"

#include "support/temporary_folder.h"

namespace frangia {
namespace {

std::vector<DeviceSettings> settings_of(const std::filesystem::path& folder, const char* devices) {
  std::ofstream(folder / "rig.toml") << "format = \"frangia-rig\"\nversion = 1\n" << devices;
  return read_device_settings(folder / "rig.toml");
}

std::string sentence_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::Input);
    return error.what();
  }
  return "no error";
}

TEST(DeviceSettings, AreReadWithTheirTypes) {
  const testing::TemporaryFolder folder;
  auto all = settings_of(folder.path(),
                         "[devices.camera]\ndriver = \"replay\"\nfolder = \"frames\"\nloop = true\n"
                         "gains = [1, 2.5]\nbits = 12\n");
  ASSERT_EQ(all.size(), 1U);
  DeviceSettings& camera = all.front();
  EXPECT_EQ(camera.device(), "camera");
  EXPECT_EQ(camera.driver(), "replay");
  EXPECT_EQ(camera.path("folder"), folder.path() / "frames");
  EXPECT_TRUE(camera.flag_or("loop", false));
  EXPECT_EQ(camera.numbers("gains"), (std::vector<double>{1.0, 2.5}));
  EXPECT_EQ(camera.integer_or("bits", 8, 8, 16), 12);
  EXPECT_EQ(camera.number_or("delay_ms", 3.0), 3.0);
}

TEST(DeviceSettings, NameTheFileAndTheKeyOfAnError) {
  const testing::TemporaryFolder folder;
  auto all = settings_of(folder.path(), "[devices.turntable]\nbaud = \"fast\"\nsteps = 2.5\n");
  DeviceSettings& table = all.front();
  const std::string place = (folder.path() / "rig.toml").string() + ": devices.turntable.";
  EXPECT_EQ(sentence_of([&] { static_cast<void>(table.driver()); }), place + "driver is missing");
  EXPECT_EQ(sentence_of([&] { static_cast<void>(table.number("baud")); }),
            place + "baud must be a finite number");
  EXPECT_EQ(sentence_of([&] { static_cast<void>(table.integer_or("steps", 1, 0, 9)); }),
            place + "steps must be a whole number");
}

TEST(DeviceSettings, NameADeviceByItsNameOrItsNumber) {
  const testing::TemporaryFolder folder;
  auto all = settings_of(folder.path(),
                         "[devices.fringes]\nmonitor = 0\nsecond = \"HDMI-1\"\nhalf = 0.5\n"
                         "below = -1\nlist = [1]\n");
  DeviceSettings& fringes = all.front();
  EXPECT_EQ(fringes.name_or_number("monitor", ""), "0");
  EXPECT_EQ(fringes.name_or_number("second", ""), "HDMI-1");
  EXPECT_EQ(fringes.name_or_number("missing", "last"), "last");
  for (const char* key : {"half", "below", "list"}) {
    EXPECT_EQ(sentence_of([&] { static_cast<void>(fringes.name_or_number(key, "")); }),
              (folder.path() / "rig.toml").string() + ": devices.fringes." + key +
                  " must be a name in quotes or a whole number from 0");
  }
}

TEST(DeviceSettings, WarnOfKeysThatNoDriverReads) {
  const testing::TemporaryFolder folder;
  auto all = settings_of(folder.path(), "[devices.light]\ndriver = \"x\"\nprot = \"a\"\n");
  static_cast<void>(all.front().driver());
  std::vector<std::string> warnings;
  frangia::Run run;
  run.on_warning = [&](const std::string& sentence) { warnings.push_back(sentence); };
  all.front().warn_of_unused_keys(run);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings.front().find("devices.light.prot is unknown"), std::string::npos);
}

TEST(DeviceSettings, OfARigWithoutDevicesAreEmpty) {
  const testing::TemporaryFolder folder;
  EXPECT_TRUE(settings_of(folder.path(), "").empty());
}

}  // namespace
}  // namespace frangia
