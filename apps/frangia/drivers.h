#pragma once

#include <vector>

#include "frangia/devices/driver.h"

namespace frangia {

/// The drivers of real and of simulated devices.
[[nodiscard]] std::vector<Driver> all_drivers();

}  // namespace frangia
