#include "drivers.h"

#include "frangia/devices/folder_camera.h"
#include "frangia/simulate/simulated_drivers.h"

namespace frangia {

DriverRegistry all_drivers() {
  DriverRegistry registry;
  add_simulated_drivers(registry);
  add_folder_camera(registry);
  return registry;
}

}  // namespace frangia
