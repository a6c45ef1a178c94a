#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/devices/rig_devices.h"
#include "frangia/service/project_scan.h"

namespace frangia {

/// The devices of a rig while a job uses them: watched by the guardian, and safe when it ends.
class OpenedDevices {
 public:
  /// Opens the devices within 30 s. Errors as open_devices.
  OpenedDevices(const std::filesystem::path& rig_file,
                const Rig& rig,
                const std::vector<Driver>& drivers,
                const CaptureSetup& setup,
                const Run& run)
      : hold_(setup.hold_devices ? setup.hold_devices() : nullptr) {
    constexpr double kOpen_s = 30.0;
    if (setup.guardian) guardian_.emplace(*setup.guardian);
    devices_.emplace(open_devices(rig_file,
                                  rig,
                                  drivers,
                                  Deadline::in(kOpen_s, run.stop),
                                  run,
                                  guardian_ ? &*guardian_ : nullptr));
  }

  [[nodiscard]] RigDevices& devices() { return *devices_; }

 private:
  std::shared_ptr<void> hold_;
  std::optional<Guardian> guardian_;
  std::optional<RigDevices> devices_;  ///< last: closed before the guardian ends
};

}  // namespace frangia
