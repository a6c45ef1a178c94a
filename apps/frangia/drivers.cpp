#include "drivers.h"

#include <iterator>
#include <utility>

#include "frangia/devices/hardware_drivers.h"
#include "frangia/simulate/simulated_drivers.h"

namespace frangia {

std::vector<Driver> all_drivers() {
  std::vector<Driver> drivers = hardware_drivers();
  std::vector<Driver> simulated = simulated_drivers();
  std::move(simulated.begin(), simulated.end(), std::back_inserter(drivers));
  return drivers;
}

}  // namespace frangia
