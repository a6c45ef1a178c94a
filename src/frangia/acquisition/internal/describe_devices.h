#pragma once

#include <string>
#include <vector>

#include "frangia/devices/device_settings.h"

namespace frangia {

/// Describes the devices of a rig for comparison between the sessions of a scan, one setting per
/// line: "[camera]", "part = plate", ... Settings that state only how a device is reached, how fast
/// it is or which faults are simulated may change between sessions and are left out.
[[nodiscard]] std::string describe_devices(const std::vector<DeviceSettings>& devices);

}  // namespace frangia
