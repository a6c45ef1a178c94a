#pragma once

#include <string>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/devices/driver.h"
#include "frangia/devices/guardian.h"
#include "frangia/service/project_folder.h"

namespace frangia {

/// The lines of a table [devices.NAME] that a client chose.
struct DeviceChoice {
  std::string table;  ///< "camera", "fringes", "line", "light" or "turntable"
  std::string lines;  ///< as FoundDevice::settings: `driver = "..."` and further settings
};

/// Replaces the devices of a project's rig by those of the choices. A project without a rig gets
/// one that states what the devices report: the sizes of camera and projector; the rest is for the
/// calibration. A rig that is not calibrated takes over these sizes, too.
///
/// Camera and display are opened for that, by `drivers`; nothing moves and no light is on.
/// @errors   Error(Input) that names the file and the key: as `check_given_devices`, no camera or
///           no fringes among the choices, a calibrated rig whose sizes differ from those of the
///           devices, or a phase shifter for a rig without the geometry of its fringes;
///           Error(Device) when a device does not answer; Error(File)
void choose_devices(const ProjectFolder& project,
                    const std::vector<DeviceChoice>& choices,
                    const std::vector<Driver>& drivers,
                    Guardian* guardian = nullptr,
                    const Run& run = {});

}  // namespace frangia
