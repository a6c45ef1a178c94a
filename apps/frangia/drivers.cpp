#include "drivers.h"

#include <iterator>
#include <utility>

#include "frangia/devices/hardware_drivers.h"
#include "frangia/simulate/simulated_drivers.h"

namespace frangia {

namespace {

std::vector<Driver> with_hardware(std::vector<Driver> simulated) {
  std::vector<Driver> drivers = hardware_drivers();
  std::move(simulated.begin(), simulated.end(), std::back_inserter(drivers));
  return drivers;
}

}  // namespace

std::vector<Driver> all_drivers() {
  return with_hardware(simulated_drivers());
}

std::vector<Driver> all_drivers(const SimulatedBoard& board) {
  return with_hardware(simulated_drivers(board));
}

GuardianProgram guardian_program() {
  return {"/proc/self/exe", {"frangia", "guardian"}};
}

OpenRig::OpenRig(const std::filesystem::path& rig_file, const Rig& rig, const Run& run)
    : devices_(open_devices(
          rig_file, rig, all_drivers(), Deadline::in(30.0, run.stop), run, &session_.guardian)) {}

OpenRig::OpenRig(const std::filesystem::path& rig_file,
                 const Rig& rig,
                 const SimulatedBoard& board,
                 const Run& run)
    : devices_(open_devices(rig_file,
                            rig,
                            all_drivers(board),
                            Deadline::in(30.0, run.stop),
                            run,
                            &session_.guardian)) {}

}  // namespace frangia
