#pragma once

#include <memory>
#include <vector>

#include "frangia/devices/driver.h"
#include "frangia/rig/board.h"

namespace frangia {

struct SimulatedBench;

/// A board that stands before the simulated camera in place of its part.
struct SimulatedBoard {
  Board board;                ///< what is printed on it
  int poses = 12;             ///< placed by hand, a new one for each view
  bool on_turntable = false;  ///< the board stands on the turntable instead
  double turn_rad = 1.0;      ///< of the turntable, within which the board is seen whole
};

/// Drivers of simulated devices: "simulated" (camera, light, line, turntable), "simulated-piezo"
/// and "simulated-display". The devices of one list share a bench: the camera images the state that
/// the others set. docs/devices.md lists their settings.
[[nodiscard]] std::vector<Driver> simulated_drivers();

/// The same with a board instead of the part that rig.toml names.
[[nodiscard]] std::vector<Driver> simulated_drivers(const SimulatedBoard& board);

/// Drivers over a bench that the caller shares, for example with a camera emulator.
[[nodiscard]] std::vector<Driver> simulated_drivers(const std::shared_ptr<SimulatedBench>& bench);

}  // namespace frangia
