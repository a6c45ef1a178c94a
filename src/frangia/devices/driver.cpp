#include "frangia/devices/driver.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace frangia {

std::string table_name(DeviceKind kind) {
  switch (kind) {
    case DeviceKind::Camera:
      return "camera";
    case DeviceKind::PhaseShifter:
    case DeviceKind::PatternDisplay:
      return "fringes";
    case DeviceKind::LaserSheet:
      return "line";
    case DeviceKind::Light:
      return "light";
    case DeviceKind::Turntable:
      return "turntable";
  }
  return {};
}

const Driver& driver_for(DeviceSettings& settings, const std::vector<Driver>& drivers) {
  const std::string wanted = settings.driver();
  std::vector<std::string> names;
  const std::string& device = settings.device();
  const std::string table =
      device.starts_with(kFurtherCamera) ? table_name(DeviceKind::Camera) : device;
  for (const Driver& driver : drivers) {
    if (table_name(driver.kind) != table) continue;
    if (driver.name == wanted) return driver;
    names.push_back(driver.name);
  }
  settings.fail("driver",
                fmt::format("is \"{}\"; the drivers for [devices.{}] are {}",
                            wanted,
                            settings.device(),
                            fmt::join(names, ", ")));
}

}  // namespace frangia
