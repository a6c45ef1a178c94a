#pragma once

#include "frangia/devices/driver.h"

namespace frangia {

/// The driver "folder": a camera that replays the frames of a scan folder by their names,
/// `views/FOLDER/PATTERN-FRAME.png` or `PATTERN-FRAME@EXPOSURE.png`, with the view folders in
/// alphabetical order. Its setting is `folder`.
///
/// @errors   Error(Input) that names the file and the key when there is no frame; Error(Device)
///          that names a missing frame
[[nodiscard]] Driver folder_camera_driver();

}  // namespace frangia
