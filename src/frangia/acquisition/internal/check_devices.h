#pragma once

#include "frangia/acquisition/capture_options.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/devices/rig_devices.h"

namespace frangia {

/// Checks, before any light is on, that the devices can show the patterns at their exposures and
/// reach the angles of a plan.
///
/// @errors   Error(Input) that names the table that rig.toml lacks, the pattern or the angle
void check_devices(const RigDevices& devices, const Scan& plan, const CaptureOptions& options);

}  // namespace frangia
