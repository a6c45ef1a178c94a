#pragma once

#include <vector>

#include "frangia/devices/driver.h"

namespace frangia {

/// Turntables on boards with GRBL, Marlin or Horus, and lamps and lasers on their outputs. Devices
/// that name the same port share its board.
[[nodiscard]] std::vector<Driver> board_drivers();

}  // namespace frangia
