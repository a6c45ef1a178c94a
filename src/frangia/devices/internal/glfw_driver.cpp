#include <cstdlib>

#include "frangia/devices/internal/glfw_display.h"

namespace frangia {

Driver glfw_driver() {
  Driver driver;
  driver.name = "monitor";
  driver.kind = DeviceKind::PatternDisplay;
#ifdef FRANGIA_WITH_GLFW
  driver.description = "a projector connected as a monitor, through GLFW";
  driver.open =
      [](DeviceSettings& settings, const Rig& rig, const Deadline&) -> std::unique_ptr<Device> {
    GlfwSettings display;
    display.monitor = settings.name_or_number("monitor", "");
    display.delay_s = settings.number_or("delay_s", display.delay_s, 0.0, 10.0);
    display.response = rig.projector.response;
    return open_glfw_display(display);
  };
  driver.find = [](const Deadline&) -> std::vector<FoundDevice> {
    const bool screen = std::getenv("DISPLAY") != nullptr ||        // NOLINT(concurrency-mt-unsafe)
                        std::getenv("WAYLAND_DISPLAY") != nullptr;  // NOLINT(concurrency-mt-unsafe)
    return screen ? find_glfw_monitors() : std::vector<FoundDevice>{};
  };
  driver.identify = identify_glfw_monitors;
#else
  driver.description = "a projector connected as a monitor; not in this build";
  driver.open =
      [](DeviceSettings& settings, const Rig&, const Deadline&) -> std::unique_ptr<Device> {
    settings.fail("driver",
                  "is \"monitor\", which this build does not include; install "
                  "libglfw3-dev and build again");
  };
#endif
  return driver;
}

}  // namespace frangia
