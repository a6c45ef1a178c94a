#pragma once

#include "frangia/core/run.h"
#include "frangia/rig/board.h"
#include "frangia/service/capture_settings.h"
#include "frangia/service/project_folder.h"
#include "frangia/service/project_scan.h"
#include "frangia/service/turntable_axis.h"

namespace frangia {

/// Finds the axis of the turntable with a board that stands on it: captures seven views while the
/// table turns by 60 degrees, and writes the axis into the project's rig.toml, whose rig is
/// calibrated. The views are kept in the project until the next search.
///
/// @errors   as open_devices, calibrate_capture and calibrate_turntable; rig.toml is then unchanged
[[nodiscard]] FoundAxis calibrate_axis(const ProjectFolder& project,
                                       const Board& board,
                                       const CaptureSettings& settings,
                                       const CaptureSetup& setup,
                                       const Run& run);

/// The same with any part that stands on the table: eight views all around.
///
/// @errors   as open_devices, capture_scan and find_turntable_axis; rig.toml is then unchanged
[[nodiscard]] FoundAxis calibrate_axis_by_part(const ProjectFolder& project,
                                               const CaptureSettings& settings,
                                               const CaptureSetup& setup,
                                               const Run& run);

}  // namespace frangia
