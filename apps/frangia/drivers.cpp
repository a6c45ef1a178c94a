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

GuardianProgram guardian_program() {
  return {"/proc/self/exe", {"frangia", "guardian"}};
}

OpenRig::OpenRig(const std::filesystem::path& rig_file, const Rig& rig, const Run& run)
    : devices_(open_devices(
          rig_file, rig, all_drivers(), Deadline::in(30.0, run.stop), run, &session_.guardian)) {}

}  // namespace frangia
