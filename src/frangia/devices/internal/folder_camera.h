#pragma once

#include "frangia/devices/driver.h"

namespace frangia {

/// The driver "folder": a camera that replays the frames of a scan folder, by their names:
/// `views/FOLDER/PATTERN-FRAME.png`, or `PATTERN-FRAME@EXPOSURE.png`, the view's folders in the
/// order of their names. Its setting: `folder`.
///
/// errors   Error(Input) that names file and key when there is no frame; Error(Device) that names
///          the frame that is missing
[[nodiscard]] Driver folder_camera_driver();

}  // namespace frangia
