#include "frangia/simulate/simulated_drivers.h"

#include <string>
#include <utility>

#include "frangia/simulate/internal/simulated_devices.h"

namespace frangia {
namespace {

using Open = decltype(Driver::open);

Driver driver(std::string name, DeviceKind kind, std::string what, Open open) {
  Driver made;
  made.name = std::move(name);
  made.kind = kind;
  made.description = std::move(what);
  made.open = std::move(open);
  return made;
}

Driver switch_driver(DeviceKind kind,
                     std::string what,
                     const BenchPtr& bench,
                     bool SimulatedBench::*light) {
  return driver(
      "simulated",
      kind,
      std::move(what),
      [bench, light](DeviceSettings&, const Rig&, const Deadline&) -> std::unique_ptr<Device> {
        return open_simulated_switch(bench, light);
      });
}

}  // namespace

std::vector<Driver> simulated_drivers() {
  return simulated_drivers(std::make_shared<SimulatedBench>());
}

std::vector<Driver> simulated_drivers(const SimulatedBoard& board) {
  const auto bench = std::make_shared<SimulatedBench>();
  bench->board = board;
  return simulated_drivers(bench);
}

std::vector<Driver> simulated_drivers(const BenchPtr& bench) {
  std::vector<Driver> drivers;
  drivers.push_back(driver(
      "simulated",
      DeviceKind::Camera,
      "a ray-traced camera before a part",
      [bench](DeviceSettings& settings, const Rig& rig, const Deadline&)
          -> std::unique_ptr<Device> { return open_simulated_camera(settings, rig, bench); }));
  drivers.push_back(driver(
      "simulated-piezo",
      DeviceKind::PhaseShifter,
      "an interferometer's piezo with the faults of one",
      [bench](DeviceSettings& settings, const Rig&, const Deadline&) -> std::unique_ptr<Device> {
        return open_simulated_piezo(settings, bench);
      }));
  drivers.push_back(driver(
      "simulated-display",
      DeviceKind::PatternDisplay,
      "a digital projector",
      [bench](DeviceSettings& settings, const Rig& rig, const Deadline&)
          -> std::unique_ptr<Device> { return open_simulated_display(settings, rig, bench); }));
  drivers.push_back(driver(
      "simulated",
      DeviceKind::Turntable,
      "a turntable with backlash",
      [bench](DeviceSettings& settings, const Rig&, const Deadline&) -> std::unique_ptr<Device> {
        return open_simulated_table(settings, bench);
      }));
  drivers.push_back(
      switch_driver(DeviceKind::Light, "the fringes' light", bench, &SimulatedBench::fringe_light));
  drivers.push_back(
      switch_driver(DeviceKind::LaserSheet, "a laser sheet", bench, &SimulatedBench::line_light));
  return drivers;
}

}  // namespace frangia
