#pragma once

#include <vector>

#include "frangia/devices/driver.h"

// Drivers that need no library of a vendor and no device of the system but a port or a folder.

namespace frangia {

/// Drivers of turntables on boards with GRBL, Marlin or Horus firmware, and of lamps and lasers on
/// their outputs. Devices with the same port share the board.
[[nodiscard]] std::vector<Driver> board_drivers();

/// Drivers of phase shifters and lights on instruments: SCPI, GCS 2 of Physik Instrumente, and
/// others by the commands in their manuals.
[[nodiscard]] std::vector<Driver> instrument_drivers();

/// The driver "folder": a camera that replays the frames of a scan folder by their names,
/// `views/FOLDER/PATTERN-FRAME.png` or `PATTERN-FRAME@EXPOSURE.png`, with the view folders in
/// alphabetical order. Its setting is `folder`.
///
/// @errors   Error(Input) that names the file and the key when there is no frame; Error(Device)
///          that names a missing frame
[[nodiscard]] Driver folder_camera_driver();

}  // namespace frangia
