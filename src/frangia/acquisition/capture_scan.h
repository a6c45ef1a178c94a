#pragma once

#include "frangia/acquisition/capture_options.h"
#include "frangia/core/folder_lock.h"
#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/devices/rig_devices.h"

namespace frangia {

/// Captures `plan` into `plan.folder`. An interrupted capture continues at the first missing frame
/// and gives the same bytes as an uninterrupted one on the same rig.
///
/// When a frame is exposed, all frames but the last three before it are on the disk, with their
/// checksums in the manifest. Stored frames are never changed; the frames of a set that is captured
/// again move to the folder `rejected` of their view. A failing view is retried, then skipped with
/// a warning. scan.toml is written last and holds the complete views. Then the turntable returns to
/// 0, unless a view was skipped. Lights and motion are off when the function returns or throws;
/// after a stop or a fault nothing moves.
///
/// The folder belongs to the same scan under another name or in another place. A turntable without
/// a home switch cannot find its angle again: a session that continues a scan and has to turn it
/// requires `table_at_rad`.
/// @errors   Error(Input) when another process writes to the folder, the folder holds another scan
///          (the sentence names a difference), the devices cannot capture the plan, or the
///          turntable's angle is unknown; Error(Device) when a device is lost or no view could be
///          captured; Error(File) when a file cannot be written
[[nodiscard]] CaptureReport capture_scan(const Scan& plan,
                                         RigDevices& devices,
                                         const CaptureOptions& options = {},
                                         const Run& run = {});

/// Captures as above into a folder that the caller has locked, for example before opening the
/// devices.
/// @errors   as above; Error(Input) when `lock` is that of another folder
[[nodiscard]] CaptureReport capture_scan(const Scan& plan,
                                         RigDevices& devices,
                                         const FolderLock& lock,
                                         const CaptureOptions& options = {},
                                         const Run& run = {});

}  // namespace frangia
