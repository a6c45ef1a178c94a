#pragma once

#include <cstddef>
#include <memory>

#include "frangia/core/run.h"
#include "frangia/decode/decoded_views.h"
#include "frangia/reconstruct/find_turntable_axis.h"
#include "frangia/rig/rig.h"
#include "frangia/service/capture_settings.h"
#include "frangia/service/project_folder.h"

namespace frangia {

/// The axis of a turntable in the figures that matter to a user.
struct FoundAxis {
  std::size_t views = 0;        ///< that show it
  double axis_sigma_deg = 0.0;  ///< standard deviation of its direction
  double point_sigma_mm = 0.0;  ///< standard deviation of its place at what stands on the table
  double angles_rms_deg = 0.0;  ///< by how much the views are off the angles that were commanded
  double distance_mm = 0.0;     ///< from the camera
  bool of_scan = false;         ///< the views are those of the project's scan
};

/// The figures of an axis that a part shows.
[[nodiscard]] FoundAxis figures_of(const AxisOfPart& found);

/// Writes the axis into the project's rig.toml, whose state before is kept in its history, and into
/// that of its scan, where one is complete: the frames of a scan do not depend on the axis.
///
/// @errors   as read_rig, keep_rig and write_rig
void keep_axis(const ProjectFolder& project, const Turntable& table, const Run& run);

/// The axis of the turntable as the complete scan of the project shows it. Nothing is written.
/// `known` holds views that were decoded before, and may be null.
///
/// @errors   as read_scan and find_turntable_axis
[[nodiscard]] AxisOfPart axis_of_scan(const ProjectFolder& project,
                                      const CaptureSettings& settings,
                                      const std::shared_ptr<const DecodedViews>& known,
                                      const Run& run);

}  // namespace frangia
