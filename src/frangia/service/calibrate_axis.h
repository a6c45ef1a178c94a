#pragma once

#include <cstddef>

#include "frangia/core/run.h"
#include "frangia/rig/board.h"
#include "frangia/service/capture_settings.h"
#include "frangia/service/project_folder.h"
#include "frangia/service/project_scan.h"

namespace frangia {

/// The axis of a turntable in the figures that matter to a user.
struct FoundAxis {
  std::size_t views = 0;        ///< that show it
  double axis_sigma_deg = 0.0;  ///< standard deviation of its direction
  double point_sigma_mm = 0.0;  ///< standard deviation of its place at what stands on the table
  double angles_rms_deg = 0.0;  ///< by how much the views are off the angles that were commanded
  double distance_mm = 0.0;     ///< from the camera
};

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
