#pragma once

#include <cstddef>

#include "frangia/dataset/scan_folder.h"

namespace frangia {

/// Returns a scan as one camera captured it: its rig is `rig_of_camera(scan.rig, camera)`, and the
/// folder of each view is that of the camera's frames. Camera 0 is the reference camera.
[[nodiscard]] Scan scan_of_camera(const Scan& scan, std::size_t camera);

}  // namespace frangia
