#pragma once

#include <memory>
#include <vector>

#include "frangia/devices/driver.h"

namespace frangia {

struct SimulatedBench;

/// Drivers of simulated devices: "simulated" (camera, light, line, turntable), "simulated-piezo"
/// and "simulated-display". The devices of one list share a bench: the camera images the state that
/// the others set. docs/devices.md lists their settings.
[[nodiscard]] std::vector<Driver> simulated_drivers();

/// Drivers over a bench that the caller shares, for example with a camera emulator.
[[nodiscard]] std::vector<Driver> simulated_drivers(const std::shared_ptr<SimulatedBench>& bench);

}  // namespace frangia
