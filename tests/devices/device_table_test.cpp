#include "frangia/devices/device_table.h"

#include <gtest/gtest.h>

#include "support/error_of.h"

namespace frangia {
namespace {

using testing::error_of;

std::string refusal(const std::string& lines) {
  return error_of([&] { static_cast<void>(parse_device_table(lines, "rig.toml", "turntable")); });
}

TEST(DeviceTable, IsWrittenAsItIsRead) {
  const std::string lines =
      "driver = \"grbl\"\nbacklash_deg = 0.5\nfaults = [\"stuck 90\", \"a \\\"b\\\"\"]\n"
      "gains = [1.0, 2.5]\nport = \"/dev/ttyUSB0\"\nreversed = true\nspeed_deg_per_s = 30\n";
  const DeviceSettings settings = parse_device_table(lines, "rig.toml", "turntable");
  EXPECT_EQ(device_table_lines(settings), lines);
  EXPECT_EQ(parse_device_table(device_table_lines(settings), "rig.toml", "turntable").values(),
            settings.values());
}

TEST(DeviceTable, HoldsNoOtherTables) {
  EXPECT_NE(refusal("driver = \"grbl\"\n[camera]\nsize_px = [1, 1]\n").find("turntable.camera"),
            std::string::npos);
  EXPECT_NE(refusal("driver = \"grbl\"\nhome.where = \"switch\"\n"), "");
  EXPECT_NE(refusal("\"a b\" = 1\n"), "");
  EXPECT_NE(refusal("driver = grbl\n").find("line 1"), std::string::npos);
  EXPECT_NE(refusal("home = 1979-05-27\n"), "");
}

}  // namespace
}  // namespace frangia
