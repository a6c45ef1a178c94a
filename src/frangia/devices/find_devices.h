#pragma once

#include <string>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/devices/driver.h"

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

}  // namespace frangia
