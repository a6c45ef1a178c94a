#pragma once

#include <span>
#include <string>

#include "frangia/devices/device_settings.h"
#include "frangia/service/project_folder.h"

namespace frangia {

/// A rig.toml that a client gives as text.
struct GivenRig {
  std::string rig;         ///< text of rig.toml
  std::string covariance;  ///< text of the CSV file that its [calibration] names; may be empty
};

/// Checks devices that a client described. They may name serial ports, video devices, addresses and
/// built-in parts, but no file of this machine.
///
/// @errors   Error(Input) that names the file and the key
void check_given_devices(std::span<const DeviceSettings> devices);

/// Writes the rig.toml of a project from a text, unchanged, and its covariance in the same folder.
///
/// @errors   Error(Input) as `read_rig` with start values and `check_given_devices`, or when
///           [calibration] names a file elsewhere or one that was not given; Error(File)
void write_given_rig(const ProjectFolder& project, const GivenRig& given);

}  // namespace frangia
