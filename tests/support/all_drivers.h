#pragma once

#include <vector>

#include "frangia/devices/hardware_drivers.h"
#include "frangia/simulate/simulated_drivers.h"

namespace frangia::testing {

[[nodiscard]] inline std::vector<Driver> all_drivers() {
  std::vector<Driver> all = simulated_drivers();
  for (const Driver& driver : hardware_drivers())
    all.push_back(driver);
  return all;
}

[[nodiscard]] inline std::vector<Driver> board_drivers(const SimulatedBoard& board) {
  return simulated_drivers(board);
}

}  // namespace frangia::testing
