#include <fstream>

#include <gtest/gtest.h>

#include "frangia/devices/find_devices.h"
#include "frangia/rig/write_rig.h"

#include "support/all_drivers.h"
#include "support/small_scan.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

TEST(TestDevices, ReportsEachDeviceThoughOneFails) {
  const testing::TemporaryFolder folder;
  const auto file = folder.path() / "rig.toml";
  const Rig rig = testing::small_rig("digital");
  write_rig(file, rig);
  std::ofstream(file, std::ios::app)
      << "\n[devices.camera]\ndriver = \"simulated\"\npart = \"plate\"\nmistyped = 1\n"
         "exposure_step_ms = 10.0\n"
         "[devices.fringes]\ndriver = \"simulated-display\"\n"
         "[devices.light]\ndriver = \"grbl\"\nport = \"/dev/no-such-port\"\n"
         "[devices.turntable]\ndriver = \"nothing\"\n";
  std::vector<std::string> warnings;
  frangia::Run run;
  run.on_warning = [&](const std::string& sentence) { warnings.push_back(sentence); };
  const auto tests = test_devices(file, rig, testing::all_drivers(), nullptr, run);
  ASSERT_EQ(tests.size(), 4U);
  EXPECT_EQ(tests[0].table, "camera");
  EXPECT_EQ(tests[0].driver, "simulated");
  EXPECT_NE(tests[0].name, "");
  EXPECT_NE(tests[0].answer, "");
  EXPECT_EQ(tests[0].fault, "");
  EXPECT_NE(tests[1].answer, "");
  EXPECT_EQ(tests[2].answer, "");
  EXPECT_NE(tests[2].fault.find("/dev/no-such-port"), std::string::npos);
  EXPECT_NE(tests[3].fault.find("devices.turntable.driver"), std::string::npos);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("mistyped"), std::string::npos);
}

}  // namespace
}  // namespace frangia
