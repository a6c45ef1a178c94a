#include <gtest/gtest.h>

#include "frangia/devices/device_table.h"
#include "frangia/rig/read_rig.h"
#include "frangia/rig/rig_covariance.h"
#include "frangia/rig/write_rig.h"
#include "frangia/service/rig_history.h"

#include "support/error_of.h"
#include "support/small_scan.h"
#include "support/temporary_folder.h"
#include "support/text_of.h"

namespace frangia {
namespace {

using testing::error_of;
using testing::text_of;

std::string refusal(const std::string& table, const std::string& lines) {
  return error_of([&] {
    const std::vector<DeviceSettings> devices{parse_device_table(lines, "rig.toml", table)};
    check_given_devices(devices);
  });
}

class GivenRigTest : public ::testing::Test {
 protected:
  GivenRigTest() { project_.folder = project_.scan = project_.derived = folder_.path(); }
  testing::TemporaryFolder folder_;
  ProjectFolder project_;
};

TEST_F(GivenRigTest, IsWrittenAsItIs) {
  const std::string text = rig_text(testing::small_rig("digital")) +
                           "\n# mine\n[devices.turntable]\ndriver = \"grbl\"\n"
                           "port = \"/dev/serial/by-id/usb-Arduino_Uno-if00\"\n";
  write_given_rig(project_, {.rig = text, .covariance = ""});
  EXPECT_EQ(text_of(project_.rig()), text);
}

TEST_F(GivenRigTest, BringsItsCovariance) {
  Rig rig = testing::small_rig("digital");
  rig.calibration = Calibration{.date = "2026-01-01", .board = "checkerboard", .poses = 12};
  rig.calibration->covariance_file = "rig-covariance.csv";
  const std::string text = rig_text(rig);
  ASSERT_NE(text.find("rig-covariance.csv"), std::string::npos);
  EXPECT_NE(error_of([&] {
              write_given_rig(project_, {.rig = text, .covariance = ""});
            }).find("choose both files"),
            std::string::npos);
  RigCovariance covariance;
  covariance.parameters = {"camera.focal_px"};
  covariance.covariance = Eigen::MatrixXd::Constant(1, 1, 0.25);
  write_rig_covariance(folder_.path() / "mine.csv", covariance);
  write_given_rig(project_, {.rig = text, .covariance = text_of(folder_.path() / "mine.csv")});
  EXPECT_EQ(read_rig(project_.rig()).calibration->covariance.covariance(0, 0), 0.25);
  for (const char* name : {"../rig-covariance.csv", "/etc/passwd", "rig.toml", ".csv", "a/b.csv"}) {
    rig.calibration->covariance_file = name;
    EXPECT_NE(
        error_of([&] { write_given_rig(project_, {.rig = rig_text(rig), .covariance = "x"}); }), "")
        << name;
  }
}

TEST_F(GivenRigTest, OpensNoFileForItsDevices) {
  EXPECT_EQ(refusal("turntable", "driver = \"grbl\"\nport = \"/dev/ttyACM0\"\n"), "");
  EXPECT_EQ(refusal("camera", "driver = \"v4l2\"\npath = \"/dev/video2\"\n"), "");
  EXPECT_EQ(refusal("camera", "driver = \"simulated\"\npart = \"bust\"\n"), "");
  EXPECT_EQ(refusal("fringes", "driver = \"scpi\"\nhost = \"10.0.0.3\"\nset = \"A/B {value}\"\n"),
            "");
  for (const char* path : {"/etc/passwd",
                           "/dev/../etc/passwd",
                           "/dev/tty/../sda",
                           "/dev/serial/by-id/../../sda",
                           "/dev/sda",
                           "ttyUSB0",
                           "/dev/video0/",
                           ""}) {
    EXPECT_NE(refusal("turntable", std::string("port = \"") + path + "\"\n"), "") << path;
    EXPECT_NE(refusal("camera", std::string("path = \"") + path + "\"\n"), "") << path;
  }
  EXPECT_NE(refusal("camera", "driver = \"folder\"\nfolder = \"frames\"\n"), "");
  EXPECT_NE(refusal("camera", "part = \"/tmp/part.stl\"\n"), "");
  EXPECT_NE(refusal("camera", "part = \"part.stl\"\n"), "");
  EXPECT_NE(refusal("camera", "true_rig = \"../other/rig.toml\"\n"), "");
  EXPECT_EQ(refusal("camera", "true_rig = \"true-rig.toml\"\n"), "");
}

}  // namespace
}  // namespace frangia
