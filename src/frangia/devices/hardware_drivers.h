#pragma once

#include <vector>

#include "frangia/devices/driver.h"

namespace frangia {

/// Every driver for devices that can be bought. Devices opened by one list may share a board; open
/// those of one rig by one list.
[[nodiscard]] std::vector<Driver> hardware_drivers();

}  // namespace frangia
