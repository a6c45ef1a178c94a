#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "frangia/devices/device.h"
#include "frangia/devices/device_settings.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// Kind of a device, with its table in rig.toml.
enum class DeviceKind {
  Camera,          ///< [devices.camera]: a CameraDevice
  PhaseShifter,    ///< [devices.fringes]: a PhaseShifter
  PatternDisplay,  ///< [devices.fringes]: a PatternDisplay
  LaserSheet,      ///< [devices.line]: a LaserSheetSource
  Light,           ///< [devices.light]: a SwitchDevice, the laser or lamp of the fringes
  Turntable        ///< [devices.turntable]: a TurntableDevice
};

/// Name of the table of a kind: "camera", "fringes", "line", "light", "turntable".
[[nodiscard]] std::string table_name(DeviceKind kind);

/// Beginning of the tables of further cameras: [devices.camera-NAME].
inline constexpr std::string_view kFurtherCamera = "camera-";

/// One of several ways in which a device can work.
struct DeviceMode {
  std::string name;      ///< for the user: size of the images, pixel format, images per second
  std::string settings;  ///< lines of the device's settings that select this mode
};

/// A device that a driver found on this machine.
struct FoundDevice {
  std::string name;                    ///< for the user: model and address
  std::string settings;                ///< lines for its table in rig.toml, `driver = "..."` first
  std::vector<DeviceMode> modes = {};  ///< as the device lists them; empty where it does not
};

/// The values among which a setting of a driver is chosen.
struct SettingChoices {
  std::string key;                  ///< in the table of rig.toml
  std::vector<std::string> values;  ///< the default first
};

/// Opens and finds devices of one kind. Drivers are values; a program passes a list of them.
struct Driver {
  std::string name;                      ///< value of `driver`; unique for each kind
  DeviceKind kind = DeviceKind::Camera;  ///< kind of the devices that it opens
  std::string description;  ///< one line: "GigE Vision and USB3 Vision cameras, by Aravis"
  /// Opens the device that the settings describe, disabled and dark, as an instance of the class
  /// for `kind`.
  ///
  /// @errors   Error(Input) that names the file and the key; Error(Device) when the device does not
  ///          answer
  std::function<std::unique_ptr<Device>(DeviceSettings& settings, const Rig& rig, const Deadline&)>
      open;
  /// Lists devices without disturbing them; empty when the driver cannot search.
  std::function<std::vector<FoundDevice>(const Deadline&)> find;
  /// Settings with few values, for forms.
  std::vector<SettingChoices> choices = {};
  /// Shows on each device that it finds the number that its name has there, until the deadline is
  /// over or a stop is requested; empty for devices that show nothing.
  ///
  /// @errors   Error(Device) when there is none
  std::function<void(const Deadline&)> identify = {};
};

/// The driver that `settings` name, for the kind of their table.
///
/// @errors   Error(Input) that names the file and the key and lists the available drivers
[[nodiscard]] const Driver& driver_for(DeviceSettings& settings,
                                       const std::vector<Driver>& drivers);

}  // namespace frangia
