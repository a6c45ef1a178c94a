#pragma once

#include <memory>
#include <vector>

#include "frangia/devices/driver.h"

namespace frangia {

struct SimulatedBench;

/// Drivers of devices in software: "simulated" (camera, light, line, turntable), "simulated-piezo"
/// and "simulated-display". Those of one list share a bench: the camera sees what the others did.
/// Their settings are in docs/devices.md.
[[nodiscard]] std::vector<Driver> simulated_drivers();

/// The same over a bench that the caller has, too: to show it to another camera.
[[nodiscard]] std::vector<Driver> simulated_drivers(const std::shared_ptr<SimulatedBench>& bench);

}  // namespace frangia
