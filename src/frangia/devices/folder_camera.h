#pragma once

#include "frangia/devices/driver_registry.h"

namespace frangia {

/// Adds the camera driver "folder": frames that another program or an earlier scan has left, as
/// files. Setting: `folder`, that of a scan; frame f of pattern p in view v is
/// folder/views/VVV/p-f.png. A file that is not there is a frame that does not come.
void add_folder_camera(DriverRegistry& registry);

}  // namespace frangia
