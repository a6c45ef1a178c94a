#pragma once

#include <vector>

#include "frangia/devices/driver.h"

namespace frangia {

/// Phase shifters and lights behind instruments on a line: SCPI, PI's GCS 2, and any other by the
/// commands that its manual gives.
[[nodiscard]] std::vector<Driver> instrument_drivers();

}  // namespace frangia
