#pragma once

#include "frangia/acquisition/capture_options.h"
#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/devices/rig_devices.h"

namespace frangia {

/// Captures `plan` into `plan.folder`, or the rest of it when that was interrupted: at the first
/// frame that is missing, to the same bytes as without an interruption on the same rig.
///
/// Each frame is on the disk, with its checksum in the manifest, while the next but one is taken.
/// Frames once stored are never changed; those of a set that is taken again move to the view's
/// folder `rejected`. A view that fails is tried again, then skipped and named. scan.toml is
/// written last and holds the views that are complete. Whatever happens, light and motion are off
/// at the end.
/// errors   Error(Input) when the folder holds another scan, or the devices do not suit the plan;
///          Error(Device) when a device is gone, or no view could be captured; Error(File)
[[nodiscard]] CaptureReport capture_scan(const Scan& plan,
                                         RigDevices& devices,
                                         const CaptureOptions& options = {},
                                         const Run& run = {});

}  // namespace frangia
