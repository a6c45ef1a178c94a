#include "frangia/devices/find_devices.h"

#include <gtest/gtest.h>

#include "frangia/core/error.h"
#include "frangia/devices/internal/aravis_driver.h"

#include "support/temporary_folder.h"

#ifdef FRANGIA_WITH_ARAVIS
#include "support/fake_gige_camera.h"
#endif

namespace frangia {
namespace {

Driver finding(const std::string& name, const std::vector<FoundDevice>& found) {
  Driver driver;
  driver.name = name;
  driver.kind = DeviceKind::Turntable;
  driver.find = [found](const Deadline&) { return found; };
  return driver;
}

TEST(FindDevices, KeepsSearchingWhenOneDriverFails) {
  Driver broken = finding("broken", {});
  broken.find = [](const Deadline&) -> std::vector<FoundDevice> {
    throw Error(ErrorKind::Device, "the bus does not answer");
  };
  Driver blind = finding("blind", {});
  blind.find = nullptr;
  std::vector<std::string> warnings;
  frangia::Run run;
  run.on_warning = [&](const std::string& sentence) { warnings.push_back(sentence); };
  const auto found =
      find_devices({broken, blind, finding("grbl", {{"a port", "driver = \"grbl\"\n"}})}, run);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].driver, "grbl");
  EXPECT_EQ(found[0].kind, DeviceKind::Turntable);
  EXPECT_EQ(found[0].found.name, "a port");
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("broken devices failed: the bus does not answer"), std::string::npos);
}

TEST(FindDevices, EndsWhenItIsStopped) {
  std::stop_source stop;
  stop.request_stop();
  frangia::Run run;
  run.stop = stop.get_token();
  EXPECT_THROW(static_cast<void>(find_devices({finding("grbl", {{"a port", ""}})}, run)), Error);
}

#ifdef FRANGIA_WITH_ARAVIS
TEST(FindDevices, FindsAGigeCameraWithTheSettingsThatOpenIt) {
  const testing::TemporaryFolder folder;
  const testing::FakeGigeCamera fake("FRANGIA3", folder.path(), [](const auto&, auto*) {});
  const auto found = find_devices({aravis_driver()});
  ASSERT_FALSE(found.empty());
  EXPECT_NE(found[0].found.name.find("127.0.0.1"), std::string::npos) << found[0].found.name;
  EXPECT_NE(found[0].found.settings.find("FRANGIA3"), std::string::npos) << found[0].found.settings;
}
#endif

}  // namespace
}  // namespace frangia
