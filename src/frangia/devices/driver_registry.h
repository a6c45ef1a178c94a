#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "frangia/devices/camera_driver.h"
#include "frangia/devices/device_settings.h"
#include "frangia/devices/enable_switch.h"
#include "frangia/devices/line_source.h"
#include "frangia/devices/pattern_display.h"
#include "frangia/devices/phase_shifter.h"
#include "frangia/devices/table_driver.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// One way to reach a kind of device.
template <typename Kind>
struct Driver {
  std::string help;  ///< one line for `frangia devices`
  std::function<std::unique_ptr<Kind>(const DeviceSettings&, const Rig&)> open;
  /// What is connected now, a line each; empty when the driver cannot look.
  std::function<std::vector<std::string>()> find;
};

/// All drivers by their names in rig.toml. A value: a program adds what it was built with, a test
/// adds its own. The roles in rig.toml are the members' names in the singular.
struct DriverRegistry {
  std::map<std::string, Driver<CameraDriver>> cameras;
  std::map<std::string, Driver<PhaseShifter>> phase_shifters;
  std::map<std::string, Driver<PatternDisplay>> pattern_displays;
  std::map<std::string, Driver<LineSource>> line_sources;
  std::map<std::string, Driver<TableDriver>> turntables;
  std::map<std::string, Driver<EnableSwitch>> enable_switches;  ///< roles "lamp" and "laser"
};

/// The devices of a rig; those that rig.toml does not name are null.
struct Devices {
  std::unique_ptr<CameraDriver> camera;
  std::unique_ptr<PhaseShifter> phase_shifter;
  std::unique_ptr<PatternDisplay> pattern_display;
  std::unique_ptr<LineSource> line_source;
  std::unique_ptr<TableDriver> turntable;
  std::unique_ptr<EnableSwitch> lamp;
  std::unique_ptr<EnableSwitch> laser;

  /// All that are there, with their roles.
  [[nodiscard]] std::vector<std::pair<std::string, Device*>> all() const;
  void make_safe() const noexcept;
};

/// Opens every device of a rig and makes it safe.
///
/// errors   Error(Input) that names the file, for a role or a driver that is not known, with those
///          that are; what the drivers throw
[[nodiscard]] Devices open_devices(const std::vector<DeviceSettings>& settings,
                                   const DriverRegistry& registry,
                                   const Rig& rig,
                                   const Run& run = {});

}  // namespace frangia
