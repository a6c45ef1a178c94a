#pragma once

#include "frangia/devices/driver.h"

namespace frangia {

/// Driver of GigE Vision and USB3 Vision cameras through Aravis. In a build without Aravis the
/// driver exists and names the missing library when chosen.
///
/// Settings: `id` (name or address as the list of devices shows it; default the first camera
/// found), `pixel_format`, `region_px` = [x, y, width, height] (default the whole sensor).
[[nodiscard]] Driver aravis_driver();

}  // namespace frangia
