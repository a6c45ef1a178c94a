#pragma once

#include <vector>

#include "frangia/devices/driver.h"

namespace frangia {

/// Drivers of turntables on boards with GRBL, Marlin or Horus firmware, and of lamps and lasers on
/// their outputs. Devices with the same port share the board.
[[nodiscard]] std::vector<Driver> board_drivers();

}  // namespace frangia
