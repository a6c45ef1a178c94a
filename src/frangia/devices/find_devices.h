#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/devices/driver.h"
#include "frangia/devices/guardian.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// A device that is connected to this machine, and the driver that found it.
struct ConnectedDevice {
  DeviceKind kind = DeviceKind::Camera;  ///< table of rig.toml that it fits
  std::string driver;                    ///< name of the driver
  FoundDevice found;                     ///< name and settings
};

/// Searches with every driver that can search, without disturbing any device. A driver whose search
/// fails is a warning of `run`; the others continue.
///
/// @units    s; the time limit is that of each driver
/// @errors   Error(Cancelled) alone
[[nodiscard]] std::vector<ConnectedDevice> find_devices(const std::vector<Driver>& drivers,
                                                        const Run& run = {},
                                                        double timeout_s = 10.0);

/// What a device of a rig answered to its test.
struct DeviceTest {
  std::string table;   ///< "camera", "fringes", ...: its [devices.NAME]
  std::string driver;  ///< as rig.toml names it
  std::string name;    ///< as the device names itself; empty when it could not be opened
  std::string answer;  ///< to its test; empty after a fault
  std::string fault;   ///< instead of an answer: what is wrong and what to do
};

/// Opens and queries every device of a rig.toml, even if another one fails. Nothing moves and no
/// light is on; all devices are safe afterwards. A `guardian` watches them meanwhile.
///
/// Unused keys are warnings of `run`.
/// @errors   as `read_device_settings`; Error(Cancelled). Faults of devices are in the result.
[[nodiscard]] std::vector<DeviceTest> test_devices(const std::filesystem::path& rig_file,
                                                   const Rig& rig,
                                                   const std::vector<Driver>& drivers,
                                                   Guardian* guardian = nullptr,
                                                   const Run& run = {},
                                                   double timeout_s = 10.0);

}  // namespace frangia
