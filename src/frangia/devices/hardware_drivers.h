#pragma once

#include <vector>

#include "frangia/devices/driver.h"

namespace frangia {

/// The drivers of all supported hardware. Devices on the same board share its connection when one
/// list opens them, so open all devices of a rig with one list.
[[nodiscard]] std::vector<Driver> hardware_drivers();

}  // namespace frangia
