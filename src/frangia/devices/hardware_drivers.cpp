#include "frangia/devices/hardware_drivers.h"

#include <iterator>
#include <utility>

#include "frangia/devices/internal/aravis_driver.h"
#include "frangia/devices/internal/glfw_display.h"
#include "frangia/devices/internal/own_drivers.h"
#include "frangia/devices/internal/v4l2_camera.h"

namespace frangia {

std::vector<Driver> hardware_drivers() {
  std::vector<Driver> drivers;
  drivers.push_back(aravis_driver());
  drivers.push_back(v4l2_driver());
  drivers.push_back(folder_camera_driver());
  drivers.push_back(glfw_driver());
  for (auto more : {board_drivers(), instrument_drivers()})
    std::move(more.begin(), more.end(), std::back_inserter(drivers));
  return drivers;
}

}  // namespace frangia
