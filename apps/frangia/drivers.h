#pragma once

#include <vector>

#include "frangia/devices/driver.h"

namespace frangia {

/// Every driver of this program: of real devices, and of simulated ones.
[[nodiscard]] std::vector<Driver> all_drivers();

}  // namespace frangia
