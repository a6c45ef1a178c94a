// Here, because the fake camera needs the port of GigE Vision, which one test at a time has.
#include "frangia/service/choose_devices.h"

#include <fstream>
#include <optional>

#include <gtest/gtest.h>

#include "frangia/devices/find_devices.h"
#include "frangia/devices/pattern_display.h"
#include "frangia/rig/read_rig.h"
#include "frangia/rig/write_rig.h"

#include "support/all_drivers.h"
#include "support/error_of.h"
#include "support/small_scan.h"
#include "support/temporary_folder.h"
#include "support/text_of.h"

#ifdef FRANGIA_WITH_ARAVIS
#include "support/fake_gige_camera.h"
#endif

namespace frangia {
namespace {

using testing::error_of;

/// A projector that exists wherever the test runs.
class Screen final : public PatternDisplay {
 public:
  [[nodiscard]] std::string name() const override { return "screen"; }
  [[nodiscard]] std::string test(const Deadline& /*until*/) override { return "works"; }
  void make_safe() noexcept override {}
  [[nodiscard]] const DisplayInfo& info() const override { return info_; }
  void show(const Image<float>& /*picture*/, const Deadline& /*until*/) override {}
  void show_dark(const Deadline& /*until*/) override {}
  [[nodiscard]] double delay_s() const override { return 0.0; }
  void set_delay(double /*seconds*/) override {}

 private:
  DisplayInfo info_{.width_px = 1280, .height_px = 800, .refresh_period_ms = 0.0};
};

class ChooseDevices : public ::testing::Test {
 protected:
  ChooseDevices() {
    Driver screen;
    screen.name = "screen";
    screen.kind = DeviceKind::PatternDisplay;
    screen.open = [](DeviceSettings&, const Rig&, const Deadline&) {
      return std::make_unique<Screen>();
    };
    drivers_.push_back(screen);
    project_.folder = project_.scan = project_.derived = folder_.path();
  }
  void choose(const std::vector<DeviceChoice>& choices) const {
    choose_devices(project_, choices, drivers_);
  }
  [[nodiscard]] std::string text() const { return testing::text_of(project_.rig()); }

  testing::TemporaryFolder folder_;
  ProjectFolder project_;
  std::vector<Driver> drivers_ = testing::all_drivers();
  DeviceChoice screen_{"fringes", "driver = \"screen\"\n"};
};

TEST_F(ChooseDevices, KeepsTheTablesOfFurtherCameras) {
  const Rig rig = testing::small_rig("binocular");
  write_rig(project_.rig(), rig);
  std::ofstream(project_.rig(), std::ios::app)
      << "\n[devices.camera]\ndriver = \"simulated\"\npart = \"plate\"\n"
      << "\n[devices.camera-left]\ndriver = \"simulated\"\npart = \"plate\"\nseed = 7\n"
      << "\n[devices.light]\ndriver = \"simulated\"\n";
  choose({{"camera", "driver = \"simulated\"\npart = \"bust\"\n"},
          {"fringes", "driver = \"simulated-display\"\n"}});
  EXPECT_NE(text().find("[devices.camera-left]"), std::string::npos);
  EXPECT_NE(text().find("seed = 7"), std::string::npos);
  EXPECT_NE(text().find("part = \"bust\""), std::string::npos);
  EXPECT_EQ(text().find("[devices.light]"), std::string::npos) << "it was not chosen again";
  EXPECT_EQ(read_rig(project_.rig()).cameras.size(), 2U);
}

#ifdef FRANGIA_WITH_ARAVIS
TEST_F(ChooseDevices, MakesARigOfAConnectedCameraAndAProjector) {
  const testing::FakeGigeCamera fake("FRANGIA4", folder_.path(), [](const auto&, auto*) {});
  std::string camera;
  for (const ConnectedDevice& device : find_devices(drivers_))
    if (device.driver == "aravis") camera = device.found.settings;
  ASSERT_NE(camera, "") << "the fake camera is not found";
  choose({{"camera", camera + "region_px = [0, 0, 320, 240]\n"},
          screen_,
          {"turntable", "driver = \"grbl\"\nport = \"/dev/ttyUSB0\"\nhome = \"here\"\n"}});
  const Rig rig = read_rig(project_.rig(), {}, RigContent::StartValues);
  EXPECT_EQ(rig.reference().model.width_px, 320);
  EXPECT_EQ(rig.reference().model.height_px, 240);
  EXPECT_EQ(rig.reference().white_level, 255);
  const auto& projector = std::get<PinholeModel>(rig.projector.model);
  EXPECT_EQ(projector.width_px, 1280);
  EXPECT_EQ(projector.height_px, 800);
  EXPECT_FALSE(rig.reference().model.focal_px.allFinite()) << "that is for the calibration";
  const auto devices = read_device_settings(project_.rig());
  ASSERT_EQ(devices.size(), 3U);
  EXPECT_EQ(devices[0].device(), "camera");
  EXPECT_NE(text().find("FRANGIA4"), std::string::npos);
  EXPECT_NE(text().find("home = \"here\""), std::string::npos);
}
#endif

TEST_F(ChooseDevices, KeepTheGeometryOfACalibratedRig) {
  const Rig rig = testing::small_rig("digital");
  write_rig(project_.rig(), rig);
  const DeviceChoice camera{"camera", "driver = \"simulated\"\npart = \"plate\"\n"};
  choose({camera, {"fringes", "driver = \"simulated-display\"\n"}});
  const Rig kept = read_rig(project_.rig());
  EXPECT_EQ(kept.projector.position_mm, rig.projector.position_mm);
  EXPECT_EQ(read_device_settings(project_.rig()).size(), 2U);
  Rig other = rig;
  std::get<PinholeModel>(other.projector.model).width_px = 640;
  write_rig(project_.rig(), other);
  const std::string before = text();
  EXPECT_NE(error_of([&] {
              choose({camera, screen_});
            }).find("projector of 640"),
            std::string::npos);
  EXPECT_EQ(text(), before) << "a refused choice changes nothing";
}

TEST_F(ChooseDevices, NeedACameraAndFringesAndNameNoFile) {
  const DeviceChoice camera{"camera", "driver = \"simulated\"\n"};
  EXPECT_NE(error_of([&] { choose({screen_}); }).find("camera"), std::string::npos);
  EXPECT_NE(error_of([&] { choose({camera}); }).find("fringes"), std::string::npos);
  EXPECT_NE(error_of([&] {
              choose({{"camera", "driver = \"folder\"\nfolder = \"/etc\"\n"}, screen_});
            }).find("devices.camera.folder"),
            std::string::npos);
  EXPECT_NE(error_of([&] {
              choose({{"camera", "driver = \"magic\"\n"}, screen_});
            }).find("magic"),
            std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(project_.rig()));
}

}  // namespace
}  // namespace frangia
