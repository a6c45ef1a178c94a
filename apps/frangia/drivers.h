#pragma once

#include "frangia/devices/driver_registry.h"

namespace frangia {

/// All drivers that this program was built with.
[[nodiscard]] DriverRegistry all_drivers();

}  // namespace frangia
