#pragma once

#include <vector>

#include "frangia/devices/driver.h"

namespace frangia {

/// Drivers of devices in software: "simulated" (camera, light, line, turntable), "simulated-piezo"
/// and "simulated-display". Those of one list share a bench: the camera sees what the others did.
/// Their settings are in docs/devices.md.
[[nodiscard]] std::vector<Driver> simulated_drivers();

}  // namespace frangia
