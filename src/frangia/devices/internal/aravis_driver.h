#pragma once

#include "frangia/devices/driver.h"

namespace frangia {

/// Industrial cameras, GigE Vision and USB3 Vision, by Aravis. A build without Aravis has the
/// driver, too: it says so when it is chosen.
///
/// Settings: `id` (a name or address as `frangia devices` lists it; else the first camera found),
/// `pixel_format`, `region_px` = [x, y, width, height] (else the whole sensor).
[[nodiscard]] Driver aravis_driver();

}  // namespace frangia
