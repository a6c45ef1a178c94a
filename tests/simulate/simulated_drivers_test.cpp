#include "frangia/simulate/simulated_drivers.h"

#include <fstream>
#include <map>
#include <numeric>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/devices/rig_devices.h"
#include "frangia/pattern/pattern_picture.h"
#include "frangia/rig/write_rig.h"
#include "frangia/simulate/rig_presets.h"

#include "support/error_of.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

using testing::error_of;

Rig tiny_rig(const char* preset) {
  Rig rig = rig_preset(preset);
  CameraModel& model = rig.reference().model;
  model.focal_px *= 96.0 / model.width_px;
  model.principal_point_px *= 96.0 / model.width_px;
  model.height_px = model.height_px * 96 / model.width_px;
  model.width_px = 96;
  return rig;
}

RigDevices open(const char* preset, const std::map<std::string, std::string>& tables) {
  const testing::TemporaryFolder folder;
  const auto file = folder.path() / "rig.toml";
  const Rig rig = tiny_rig(preset);
  write_rig(file, rig);
  std::ofstream out(file, std::ios::app);
  for (const auto& [table, text] : tables)
    out << "\n[devices." << table << "]\n" << text;
  out.close();
  return open_devices(file, rig, simulated_drivers(), Deadline::in(5.0));
}

const std::string kSimulated = "driver = \"simulated\"\n";
const std::string kCamera = kSimulated + "part = \"plate\"\n";
const std::string kPiezo =
    "driver = \"simulated-piezo\"\nmax_command = 12\ncommand_per_turn = 10\n";

Deadline soon() {
  return Deadline::in(5.0);
}

FrameLabel label_of(int view, int frame) {
  return {view, "fringe", frame, 0, 0};
}

double mean_of(const Frame& frame) {
  const auto& pixels = std::get<Image<std::uint8_t>>(frame).pixels();
  return std::accumulate(pixels.begin(), pixels.end(), 0.0) / static_cast<double>(pixels.size());
}

double picture(const RigDevices& devices, const FrameLabel& label = label_of(0, 0)) {
  return mean_of(devices.reference()->capture(label, soon()).frame);
}

TEST(SimulatedDrivers, ExposureGainAndBlackLevelActOnTheImage) {
  const RigDevices devices = open("angular", {{"camera", kCamera}});
  const auto mean_at = [&](double exposure_ms, double gain_db, double black) {
    static_cast<void>(devices.reference()->configure({exposure_ms, gain_db, black}, soon()));
    return picture(devices);
  };
  const double plain = mean_at(5.0, 0.0, 0.0);
  EXPECT_GT(plain, 1.0);
  EXPECT_NEAR(mean_at(10.0, 0.0, 0.0), 2.0 * plain, 0.05 * plain);
  EXPECT_NEAR(mean_at(5.0, 6.0206, 0.0), 2.0 * plain, 0.05 * plain);
  EXPECT_NEAR(mean_at(5.0, 0.0, 10.0), plain + 10.0, 0.3);
}

TEST(SimulatedDrivers, PartIsTurnedOverInTheNextSetupUnderTheSameLight) {
  const std::string bust = kSimulated + "part = \"bust\"\n";
  const auto shot = [&](const RigDevices& devices, int setup) {
    FrameLabel label = label_of(0, 0);
    label.setup = setup;
    const Frame frame = devices.reference()->capture(label, soon()).frame;
    const auto pixels = std::get<Image<std::uint8_t>>(frame).pixels();
    return std::vector(pixels.begin(), pixels.end());
  };
  const RigDevices devices = open("angular", {{"camera", bust}});
  const auto upright = shot(devices, 0);
  const auto turned = shot(devices, 1);
  EXPECT_NE(upright, turned);
  EXPECT_EQ(shot(devices, 0), upright);
  EXPECT_EQ(shot(devices, 1), turned);
  const RigDevices tilted = open("angular", {{"camera", bust + "setup_tilt_deg = 90\n"}});
  EXPECT_EQ(shot(tilted, 0), upright);
  EXPECT_NE(shot(tilted, 1), turned);
}

TEST(SimulatedDrivers, FrameDependsOnItsLabelNotOnWhatWasTakenBefore) {
  const RigDevices devices = open("angular", {{"camera", kCamera}, {"fringes", kPiezo}});
  devices.shifter->drive(2.5, soon());
  const auto bytes = [&](int frame) {
    const CapturedFrame taken = devices.reference()->capture(label_of(0, frame), soon());
    const auto pixels = std::get<Image<std::uint8_t>>(taken.frame).pixels();
    return std::vector<std::uint8_t>(pixels.begin(), pixels.end());
  };
  const auto first = bytes(1);
  const auto other = bytes(2);
  EXPECT_TRUE(first == bytes(1));
  EXPECT_FALSE(first == other);
}

TEST(SimulatedDrivers, PiezoComesBackToTheSamePhaseOnlyFromTheSameSide) {
  const RigDevices devices =
      open("angular",
           {{"camera", kCamera}, {"fringes", kPiezo + "hysteresis = 2.0\ntime_constant_s = 0\n"}});
  devices.shifter->drive(2.5, soon());
  const double from_below = picture(devices);
  devices.shifter->drive(10.0, soon());
  devices.shifter->drive(2.5, soon());
  EXPECT_NE(picture(devices), from_below);
  devices.shifter->drive(0.0, soon());
  devices.shifter->drive(2.5, soon());
  EXPECT_EQ(picture(devices), from_below);
}

/// 20 ms late at 50 Hz: the picture is there from 20 ms on, an exposure of 10 ms from 15 ms on sees
/// it in its second half. The room's lamp has a period of 10 ms.
TEST(SimulatedDrivers, ExposureSeesEachPictureForItsTimeAndTheFlickerOfTheRoom) {
  const auto taken = [](const std::string& room, double delay_s, double exposure_ms) {
    const RigDevices devices =
        open("digital",
             {{"camera", kCamera + room},
              {"fringes", "driver = \"simulated-display\"\nlatency_ms = 20\nrefresh_hz = 50\n"}});
    devices.display->set_delay(delay_s);
    static_cast<void>(devices.reference()->configure({exposure_ms, 0.0, 10.0}, soon()));
    const DisplayInfo& info = devices.display->info();
    devices.display->show(Image<float>(info.width_px, info.height_px, 1.0F), soon());
    return picture(devices);
  };
  const double before = taken("contrast = 1.0\n", 0.0, 10.0);
  const double after = taken("contrast = 1.0\n", 0.02, 10.0);
  EXPECT_NEAR(before, 10.0, 0.3);
  EXPECT_GT(after, before + 5.0);
  EXPECT_NEAR(taken("contrast = 1.0\n", 0.015, 10.0), 0.5 * (before + after), 0.3);

  const std::string lamp = "ambient = 0.4\nmains_hz = 50\nroom_flicker = 0.5\n";
  const double even = taken(lamp, 0.0, 10.0) - 10.0;
  EXPECT_NEAR(taken(lamp, 0.005, 10.0) - 10.0, even, 0.01 * even) << "a whole period";
  // Around its peak: sin(x) / x of a quarter of a period, x = pi / 4.
  const double peak = 1.0 + 0.5 * std::sin(kPi / 4.0) / (kPi / 4.0);
  EXPECT_NEAR(taken(lamp, 0.00875, 2.5) - 10.0, 0.25 * even * peak, 0.02 * even);
}

TEST(SimulatedDrivers, TableArrivesAtTheSamePlaceFromBothSides) {
  const RigDevices devices = open(
      "angular",
      {{"camera", kCamera}, {"turntable", kSimulated + "backlash_deg = 3\napproach_deg = 4\n"}});
  const auto mean_at = [&](double deg) {
    devices.turntable->move_to(rad_from_deg(deg), soon());
    return picture(devices);
  };
  devices.turntable->enable(true, soon());
  devices.turntable->home(soon());
  const double up = mean_at(30.0);
  EXPECT_NE(mean_at(60.0), up);
  EXPECT_EQ(mean_at(30.0), up);
}

TEST(SimulatedDrivers, DisplayLightsThePartWithWhatItShows) {
  const RigDevices devices =
      open("digital", {{"camera", kCamera}, {"fringes", "driver = \"simulated-display\"\n"}});
  const auto& info = devices.display->info();
  const double dark = picture(devices);
  devices.display->show(Image<float>(info.width_px, info.height_px, 1.0F), soon());
  const double bright = picture(devices);
  EXPECT_GT(bright, dark + 10.0);
  Pattern fringes{.name = "fringe", .period_px = 20.0, .shifts_rad = {0.0}};
  devices.display->show(pattern_picture(fringes, 0, info.width_px, info.height_px), soon());
  EXPECT_NEAR(picture(devices), 0.5 * (bright + 0.1 * bright / 1.9), 0.05 * bright);
}

TEST(SimulatedDrivers, LightIsOffUntilItIsSwitchedOn) {
  const RigDevices devices = open("angular", {{"camera", kCamera}, {"light", kSimulated}});
  const double dark = picture(devices);
  devices.light->set(true, soon());
  EXPECT_GT(picture(devices), dark + 5.0);
  devices.light->make_safe();
  EXPECT_EQ(picture(devices), dark);
}

TEST(SimulatedDrivers, CameraFaultsHappenWhereTheScriptSays) {
  const RigDevices devices =
      open("angular",
           {{"camera",
             kCamera + "faults = [\"lost 1 fringe 2\", \"incomplete 1 fringe 3\", "
                       "\"saturated 2\", \"unplugged 3\"]\n"}});
  const auto take = [&](int view, int frame) {
    return devices.reference()->capture(label_of(view, frame), soon());
  };
  EXPECT_NE(error_of([&] { static_cast<void>(take(1, 2)); }).find("no frame came"),
            std::string::npos);
  EXPECT_TRUE(take(1, 2).complete);
  EXPECT_FALSE(take(1, 3).complete);
  EXPECT_TRUE(take(1, 3).complete);
  EXPECT_GT(mean_of(take(2, 0).frame), 2.0 * mean_of(take(0, 0).frame));
  EXPECT_NE(error_of([&] { static_cast<void>(take(3, 0)); }).find("unplugged"), std::string::npos);
  EXPECT_NE(
      error_of([&] { static_cast<void>(devices.reference()->test(soon())); }).find("unplugged"),
      std::string::npos);
}

TEST(SimulatedDrivers, TableFaultsLeaveTheAngleUnknownUntilItIsHomed) {
  const RigDevices devices =
      open("angular",
           {{"camera", kCamera},
            {"turntable", kSimulated + "faults = [\"stuck 90\", \"alarm 45\"]\nmax_deg = 180\n"}});
  TurntableDevice& table = *devices.turntable;
  const auto move = [&](double deg) {
    return error_of([&] { table.move_to(rad_from_deg(deg), soon()); });
  };
  EXPECT_NE(move(10.0).find("is not enabled"), std::string::npos);
  for (const double faulty : {90.0, 45.0}) {
    table.enable(true, soon());
    table.home(soon());
    EXPECT_NE(move(faulty), "");
    EXPECT_FALSE(table.angle_rad());
    table.enable(true, soon());
    EXPECT_NE(move(faulty).find("home it first"), std::string::npos) << "never a silent resume";
    table.home(soon());
    EXPECT_EQ(move(faulty), "");
  }
  EXPECT_NE(move(200.0).find("200 degrees is outside its limits"), std::string::npos);
}

TEST(SimulatedDrivers, UnknownFaultIsNamed) {
  const std::string sentence = error_of([] {
    static_cast<void>(open("angular", {{"camera", kCamera + "faults = [\"sneezes 1\"]\n"}}));
  });
  EXPECT_NE(sentence.find("devices.camera.faults holds \"sneezes\""), std::string::npos)
      << sentence;
}

}  // namespace
}  // namespace frangia
