#pragma once

#include "frangia/acquisition/capture_options.h"
#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/devices/rig_devices.h"

namespace frangia {

/// Captures `plan` into `plan.folder`. An interrupted capture continues at the first missing frame
/// and gives the same bytes as an uninterrupted one on the same rig.
///
/// A frame and its checksum in the manifest are on the disk before the next but one is exposed.
/// Stored frames are never changed; the frames of a set that is captured again move to the folder
/// `rejected` of their view. A failing view is retried, then skipped with a warning. scan.toml is
/// written last and holds the complete views. Lights and motion are off when the function returns
/// or throws.
/// @errors   Error(Input) when the folder holds another scan, or the devices cannot capture the
///          plan; Error(Device) when a device is lost or no view could be captured; Error(File)
///          when a file cannot be written
[[nodiscard]] CaptureReport capture_scan(const Scan& plan,
                                         RigDevices& devices,
                                         const CaptureOptions& options = {},
                                         const Run& run = {});

}  // namespace frangia
