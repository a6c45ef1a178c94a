#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/devices/internal/board_devices.h"
#include "frangia/devices/internal/open_transport.h"
#include "frangia/devices/internal/own_drivers.h"

namespace frangia {
namespace {

struct Firmware {
  std::string name;
  std::string what;
  int baud = 115200;
  std::string on;
  std::string off;
  std::unique_ptr<MotionController> (*make)(std::unique_ptr<Transport>,
                                            const MotionControllerSettings&);
};

/// The open boards by the names of their lines.
using Boards = std::map<std::string, std::weak_ptr<MotionController>>;

/// Only a table has an axis.
MotionControllerSettings read_firmware(DeviceSettings& settings, bool has_axis) {
  MotionControllerSettings firmware;
  firmware.boot_s = settings.number_or("boot_s", 2.5, 0.0, 30.0);
  if (!has_axis) return firmware;
  firmware.axis = settings.choice("axis", {"X", "Y", "Z", "A"}).front();
  firmware.steps_per_unit = settings.number_or("steps_per_degree", 0.0, 0.0, 1e6) /
                            settings.number_or("units_per_degree", 1.0, 1e-6, 1e6);
  return firmware;
}

std::shared_ptr<MotionController> open_board(Boards& boards,
                                             const Firmware& firmware,
                                             DeviceSettings& settings,
                                             bool has_axis,
                                             const Deadline& deadline) {
  const MotionControllerSettings wanted = read_firmware(settings, has_axis);
  std::weak_ptr<MotionController>& known = boards[configured_transport_name(settings)];
  if (auto board = known.lock()) {
    static_cast<void>(settings.integer_or("baud", firmware.baud, 50, 4'000'000));
    if (has_axis) board->use(wanted);
    return board;
  }
  std::shared_ptr<MotionController> board =
      firmware.make(open_configured_transport(settings, deadline, firmware.baud), wanted);
  board->connect(deadline);
  known = board;
  return board;
}

StepperTurntableOptions read_table(DeviceSettings& settings, bool has_switch) {
  StepperTurntableOptions options;
  constexpr double kFar = std::numeric_limits<double>::infinity();
  const std::string home =
      has_switch ? settings.choice("home", {"here", "switch"}) : settings.choice("home", {"here"});
  options.info.can_home = home == "switch";
  options.info.min_rad = rad_from_deg(settings.number_or("min_deg", -kFar));
  options.info.max_rad = rad_from_deg(settings.number_or("max_deg", kFar));
  if (options.info.min_rad >= options.info.max_rad) {
    settings.fail("min_deg", "must be below max_deg");
  }
  options.units_per_degree = settings.number_or("units_per_degree", 1.0, 1e-6, 1e6);
  options.reversed = settings.flag_or("reversed", false);
  options.backlash_deg = settings.number_or("backlash_deg", 0.0, 0.0, 30.0);
  options.speed_deg_per_s = settings.number_or("speed_deg_per_s", 20.0, 0.01, 720.0);
  options.settle_s = settings.number_or("settle_s", 0.0, 0.0, 60.0);
  options.home_time_s = settings.number_or("home_time_s", options.home_time_s, 0.0, 3600.0);
  return options;
}

std::vector<FoundDevice> find_ports(const std::string& driver) {
  std::vector<FoundDevice> found;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator("/dev", none)) {
    const std::string name = entry.path().filename().string();
    if (name.rfind("ttyUSB", 0) != 0 && name.rfind("ttyACM", 0) != 0) continue;
    // Opening the port would reset a board that may be in use.
    found.push_back(
        {fmt::format("serial port {}; opening it shows what is connected", entry.path().string()),
         fmt::format("driver = \"{}\"\nport = \"{}\"\n", driver, entry.path().string())});
  }
  return found;
}

Driver table_driver(const Firmware& firmware, const std::shared_ptr<Boards>& boards) {
  Driver driver;
  driver.name = firmware.name;
  driver.kind = DeviceKind::Turntable;
  driver.description = "turntable on a board with " + firmware.what;
  driver.open = [firmware, boards](DeviceSettings& settings,
                                   const Rig& /*rig*/,
                                   const Deadline& deadline) -> std::unique_ptr<Device> {
    const StepperTurntableOptions options = read_table(settings, firmware.name != "horus");
    return std::make_unique<StepperTurntable>(
        open_board(*boards, firmware, settings, true, deadline), options);
  };
  if (firmware.name == "grbl") {
    driver.find = [](const Deadline& /*deadline*/) { return find_ports("grbl"); };
  }
  return driver;
}

Driver switch_driver(const Firmware& firmware,
                     DeviceKind kind,
                     const std::shared_ptr<Boards>& boards) {
  Driver driver;
  driver.name = firmware.name;
  driver.kind = kind;
  driver.description = "lamp or laser on an output of a board with " + firmware.what;
  driver.open = [firmware, boards](DeviceSettings& settings,
                                   const Rig& /*rig*/,
                                   const Deadline& deadline) -> std::unique_ptr<Device> {
    const std::string on = settings.text_or("on", firmware.on);
    const std::string off = settings.text_or("off", firmware.off);
    auto board = open_board(*boards, firmware, settings, false, deadline);
    auto light = std::make_unique<BoardSwitch>(std::move(board), on, off);
    light->set(false, deadline);
    return light;
  };
  return driver;
}

}  // namespace

std::vector<Driver> board_drivers() {
  const auto boards = std::make_shared<Boards>();
  std::vector<Driver> drivers;
  for (const Firmware& firmware :
       {Firmware{"grbl", "GRBL 1.1", 115200, "M3 S1000", "M5", make_grbl},
        Firmware{"marlin", "Marlin", 115200, "M106 S255", "M107", make_marlin},
        Firmware{"horus", "Horus 0.2 (Ciclop)", 115200, "M71T1", "M70T1", make_horus}}) {
    drivers.push_back(table_driver(firmware, boards));
    drivers.push_back(switch_driver(firmware, DeviceKind::Light, boards));
    drivers.push_back(switch_driver(firmware, DeviceKind::LaserSheet, boards));
  }
  return drivers;
}

}  // namespace frangia
