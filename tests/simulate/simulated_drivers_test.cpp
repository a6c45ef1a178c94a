#include "frangia/simulate/simulated_drivers.h"

#include <chrono>
#include <numeric>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/devices/device_error.h"
#include "frangia/simulate/rig_presets.h"

namespace frangia {
namespace {

Rig tiny_rig(const char* preset) {
  Rig rig = rig_preset(preset);
  Lens& lens = rig.camera.lens;
  lens.focal_px *= 96.0 / lens.width_px;
  lens.principal_point_px *= 96.0 / lens.width_px;
  lens.height_px = lens.height_px * 96 / lens.width_px;
  lens.width_px = 96;
  return rig;
}

using Values = std::map<std::string, SettingValue>;

Devices open(const char* preset, const std::map<std::string, Values>& roles) {
  DriverRegistry registry;
  add_simulated_drivers(registry);
  std::vector<DeviceSettings> settings;
  for (const auto& [role, values] : roles) {
    Values all = values;
    all["driver"] = std::string("simulated");
    settings.emplace_back("rig.toml", role, all);
  }
  return open_devices(settings, registry, tiny_rig(preset));
}

Deadline soon() {
  return Deadline::after(std::chrono::seconds(5));
}

double mean_of(const Frame& frame) {
  const auto& pixels = std::get<Image<std::uint8_t>>(frame).pixels();
  return std::accumulate(pixels.begin(), pixels.end(), 0.0) / static_cast<double>(pixels.size());
}

FrameId id_of(std::size_t view, int frame, int attempt = 0) {
  return {.view = view, .pattern = "fringe", .frame = frame, .attempt = attempt};
}

DeviceFault fault_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const DeviceError& error) {
    return error.fault();
  }
  throw std::runtime_error("no fault");
}

TEST(SimulatedDrivers, ExposureAndGainActOnTheImage) {
  const Devices devices = open("angular", {{"camera", {}}});
  const auto mean_at = [&](double exposure_ms, double gain_db, double black) {
    devices.camera->configure({exposure_ms, gain_db, black}, soon());
    return mean_of(devices.camera->expose(id_of(0, 0), soon()).frame);
  };
  const double plain = mean_at(5.0, 0.0, 0.0);
  EXPECT_GT(plain, 1.0);
  EXPECT_NEAR(mean_at(10.0, 0.0, 0.0), 2.0 * plain, 0.05 * plain);
  EXPECT_NEAR(mean_at(5.0, 6.0206, 0.0), 2.0 * plain, 0.05 * plain);
  EXPECT_NEAR(mean_at(5.0, 0.0, 10.0), plain + 10.0, 0.3);
}

TEST(SimulatedDrivers, FrameDependsOnItsIdentityNotOnWhatWasTakenBefore) {
  const Devices devices = open("angular", {{"camera", {}}, {"phase_shifter", {}}});
  devices.phase_shifter->drive(2.5, soon());
  const Frame first = devices.camera->expose(id_of(0, 1), soon()).frame;
  const Frame other = devices.camera->expose(id_of(0, 2), soon()).frame;
  const Frame again = devices.camera->expose(id_of(0, 1, 3), soon()).frame;
  const auto bytes = [](const Frame& frame) {
    const auto& pixels = std::get<Image<std::uint8_t>>(frame).pixels();
    return std::vector<std::uint8_t>(pixels.begin(), pixels.end());
  };
  EXPECT_EQ(bytes(first), bytes(again));
  EXPECT_NE(bytes(first), bytes(other));
}

TEST(SimulatedDrivers, PiezoComesBackToTheSamePhaseOnlyFromTheSameSide) {
  const Devices devices =
      open("angular",
           {{"camera", {}}, {"phase_shifter", {{"hysteresis_v", 2.0}, {"time_constant_ms", 0.0}}}});
  const auto picture = [&] { return mean_of(devices.camera->expose(id_of(0, 0), soon()).frame); };
  devices.phase_shifter->rest(soon());
  devices.phase_shifter->drive(2.5, soon());
  const double from_below = picture();
  devices.phase_shifter->drive(10.0, soon());
  devices.phase_shifter->drive(2.5, soon());
  EXPECT_NE(picture(), from_below);
  devices.phase_shifter->rest(soon());
  devices.phase_shifter->drive(2.5, soon());
  EXPECT_EQ(picture(), from_below);
}

TEST(SimulatedDrivers, TableArrivesAtTheSamePlaceFromBothSides) {
  const Devices devices = open("digital",
                               {{"camera", {}},
                                {"turntable", {{"backlash_deg", 3.0}, {"approach_deg", 4.0}}},
                                {"pattern_display", {}}});
  Pattern pattern{.name = "fringe", .period_px = 160.0, .shifts_rad = {0.0}};
  const auto mean_at = [&](double deg) {
    devices.turntable->move_to(rad_from_deg(deg), soon());
    devices.pattern_display->show(pattern, 0, soon());
    return mean_of(devices.camera->expose(id_of(0, 0), soon()).frame);
  };
  devices.turntable->enable(true, soon());
  devices.turntable->home(soon());
  const double up = mean_at(30.0);
  EXPECT_NE(mean_at(60.0), up);
  EXPECT_EQ(mean_at(30.0), up);
}

TEST(SimulatedDrivers, LightIsOffUntilItIsEnabled) {
  const Devices devices = open("angular", {{"camera", {}}, {"laser", {}}});
  const auto picture = [&] { return mean_of(devices.camera->expose(id_of(0, 0), soon()).frame); };
  const double dark = picture();
  devices.laser->enable(true, soon());
  EXPECT_GT(picture(), dark + 5.0);
  devices.make_safe();
  EXPECT_EQ(picture(), dark);
}

TEST(SimulatedDrivers, ScriptedFaultsHappenWhereTheScriptSays) {
  const Devices devices =
      open("angular",
           {{"camera",
             {{"faults",
               std::vector<std::string>{
                   "lost 1 fringe 2", "incomplete 1 fringe 3", "saturated 2", "unplugged 3"}}}},
            {"turntable", {{"faults", std::vector<std::string>{"stuck 90", "alarm 45"}}}}});
  const auto expose = [&](const FrameId& id) { return devices.camera->expose(id, soon()); };
  EXPECT_EQ(fault_of([&] { static_cast<void>(expose(id_of(1, 2))); }), DeviceFault::Silent);
  EXPECT_TRUE(expose(id_of(1, 2, 1)).complete);
  EXPECT_FALSE(expose(id_of(1, 3)).complete);
  EXPECT_GT(mean_of(expose(id_of(2, 0)).frame), 2.0 * mean_of(expose(id_of(0, 0)).frame));
  EXPECT_EQ(fault_of([&] { static_cast<void>(expose(id_of(3, 0))); }), DeviceFault::Lost);

  const auto move = [&](double deg) { devices.turntable->move_to(rad_from_deg(deg), soon()); };
  EXPECT_EQ(fault_of([&] { move(10.0); }), DeviceFault::Refused);  // not enabled
  devices.turntable->enable(true, soon());
  devices.turntable->home(soon());
  EXPECT_EQ(fault_of([&] { move(90.0); }), DeviceFault::Silent);
  move(90.0);
  EXPECT_EQ(fault_of([&] { move(45.0); }), DeviceFault::Alarm);
  EXPECT_EQ(fault_of([&] { move(45.0); }), DeviceFault::Alarm);  // never a silent resume
  devices.turntable->home(soon());
  move(45.0);
}

TEST(SimulatedDrivers, UnknownFaultIsNamed) {
  try {
    static_cast<void>(
        open("angular", {{"camera", {{"faults", std::vector<std::string>{"sneezes 1"}}}}}));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::Input);
    EXPECT_NE(std::string(error.what()).find("sneezes"), std::string::npos);
  }
}

}  // namespace
}  // namespace frangia
