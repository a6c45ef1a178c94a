#pragma once

#include <filesystem>
#include <vector>

#include "frangia/devices/driver.h"
#include "frangia/devices/guardian.h"
#include "frangia/devices/rig_devices.h"
#include "frangia/simulate/simulated_drivers.h"

#include "interrupt.h"

namespace frangia {

/// The drivers of real and of simulated devices.
[[nodiscard]] std::vector<Driver> all_drivers();
/// The same; before a simulated camera stands a board.
[[nodiscard]] std::vector<Driver> all_drivers(const SimulatedBoard& board);

/// The guardian process of this program: `frangia guardian`, which the help does not list.
[[nodiscard]] GuardianProgram guardian_program();

/// Devices of this program: they are made safe before a signal ends it, and a guardian process
/// makes them safe when the program dies without doing so.
struct DeviceSession {
  DeviceScope scope;
  Guardian guardian{guardian_program()};
};

/// The devices of a rig within a session.
class OpenRig {
 public:
  /// Opens the devices within 30 s.
  ///
  /// @errors   as `open_devices`
  OpenRig(const std::filesystem::path& rig_file, const Rig& rig, const Run& run);
  /// The same; before a simulated camera stands a board.
  OpenRig(const std::filesystem::path& rig_file,
          const Rig& rig,
          const SimulatedBoard& board,
          const Run& run);

  [[nodiscard]] RigDevices& devices() { return devices_; }

 private:
  DeviceSession session_;
  RigDevices devices_;
};

}  // namespace frangia
