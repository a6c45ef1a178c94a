#include "frangia/devices/driver_registry.h"

#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace frangia {
namespace {

template <typename Kind>
std::unique_ptr<Kind> open(const std::map<std::string, Driver<Kind>>& drivers,
                           const DeviceSettings& settings,
                           const Rig& rig) {
  const auto found = drivers.find(settings.driver());
  if (found != drivers.end()) return found->second.open(settings, rig);
  std::vector<std::string> names;
  for (const auto& driver : drivers)
    names.push_back(driver.first);
  settings.fail("driver",
                names.empty() ? fmt::format("is \"{}\", but this program has no driver for a {}",
                                            settings.driver(),
                                            settings.role())
                              : fmt::format("is \"{}\", which is not known; it must be one of: {}",
                                            settings.driver(),
                                            fmt::join(names, ", ")));
}

void open_one(const DeviceSettings& settings,
              const DriverRegistry& registry,
              const Rig& rig,
              Devices& devices) {
  const std::string& role = settings.role();
  if (role == "camera") {
    devices.camera = open(registry.cameras, settings, rig);
  } else if (role == "phase_shifter") {
    devices.phase_shifter = open(registry.phase_shifters, settings, rig);
  } else if (role == "pattern_display") {
    devices.pattern_display = open(registry.pattern_displays, settings, rig);
  } else if (role == "line_source") {
    devices.line_source = open(registry.line_sources, settings, rig);
  } else if (role == "turntable") {
    devices.turntable = open(registry.turntables, settings, rig);
  } else if (role == "lamp") {
    devices.lamp = open(registry.enable_switches, settings, rig);
  } else if (role == "laser") {
    devices.laser = open(registry.enable_switches, settings, rig);
  } else {
    settings.fail("driver",
                  "belongs to no role that is known; a rig's devices are camera, phase_shifter, "
                  "pattern_display, line_source, turntable, lamp and laser");
  }
}

}  // namespace

std::vector<std::pair<std::string, Device*>> Devices::all() const {
  std::vector<std::pair<std::string, Device*>> present;
  const auto add = [&](const char* role, Device* device) {
    if (device != nullptr) present.emplace_back(role, device);
  };
  // Light first: it is what hurts.
  add("laser", laser.get());
  add("line_source", line_source.get());
  add("lamp", lamp.get());
  add("turntable", turntable.get());
  add("phase_shifter", phase_shifter.get());
  add("pattern_display", pattern_display.get());
  add("camera", camera.get());
  return present;
}

void Devices::make_safe() const noexcept {
  for (Device* device : std::initializer_list<Device*>{laser.get(),
                                                       line_source.get(),
                                                       lamp.get(),
                                                       turntable.get(),
                                                       phase_shifter.get(),
                                                       pattern_display.get(),
                                                       camera.get()}) {
    if (device != nullptr) device->make_safe();
  }
}

Devices open_devices(const std::vector<DeviceSettings>& settings,
                     const DriverRegistry& registry,
                     const Rig& rig,
                     const Run& run) {
  Devices devices;
  try {
    for (const DeviceSettings& one : settings) {
      open_one(one, registry, rig, devices);
      one.warn_of_the_rest(run);
    }
  } catch (...) {
    devices.make_safe();
    throw;
  }
  devices.make_safe();
  return devices;
}

}  // namespace frangia
