#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "frangia/devices/device.h"
#include "frangia/devices/device_settings.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// What a driver drives, and the table of rig.toml it belongs to.
enum class DeviceKind {
  Camera,          ///< [devices.camera]: a CameraDevice
  PhaseShifter,    ///< [devices.fringes]: a PhaseShifter
  PatternDisplay,  ///< [devices.fringes]: a PatternDisplay
  LaserSheet,      ///< [devices.line]: a LaserSheetSource
  Light,           ///< [devices.light]: a SwitchDevice, the fringes' laser or lamp
  Turntable        ///< [devices.turntable]: a TurntableDevice
};

/// The table's name: "camera", "fringes", "line", "light", "turntable".
[[nodiscard]] std::string table_name(DeviceKind kind);

/// A device that a driver found on this machine.
struct FoundDevice {
  std::string name;
  std::string settings;  ///< the lines for its table in rig.toml, `driver = "..."` first
};

/// A way to a kind of device. Drivers are values: a program lists those it was built with.
struct Driver {
  std::string name;  ///< `driver = "..."`; one driver a name and table
  DeviceKind kind = DeviceKind::Camera;
  std::string description;  ///< one line: "GigE Vision and USB3 Vision cameras, by Aravis"
  /// Opens the device that the settings describe, disabled and dark. It must be of the class that
  /// `kind` promises.
  /// errors   Error(Input) naming file and key; Error(Device) when it does not answer
  std::function<std::unique_ptr<Device>(DeviceSettings& settings, const Rig& rig, const Deadline&)>
      open;
  /// Looks for devices without disturbing any; empty when the driver cannot look.
  std::function<std::vector<FoundDevice>(const Deadline&)> find;
};

/// The driver that `settings` name, for the table they stand in.
///
/// errors   Error(Input) that names file and key and lists the drivers there are
[[nodiscard]] const Driver& driver_for(DeviceSettings& settings,
                                       const std::vector<Driver>& drivers);

}  // namespace frangia
