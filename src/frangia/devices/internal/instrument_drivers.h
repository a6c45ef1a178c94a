#pragma once

#include <vector>

#include "frangia/devices/driver.h"

namespace frangia {

/// Drivers of phase shifters and lights on instruments: SCPI, GCS 2 of Physik Instrumente, and
/// others by the commands in their manuals.
[[nodiscard]] std::vector<Driver> instrument_drivers();

}  // namespace frangia
