#pragma once

#include "frangia/acquisition/measure_display.h"
#include "frangia/core/run.h"
#include "frangia/service/capture_settings.h"
#include "frangia/service/project_folder.h"
#include "frangia/service/project_scan.h"

namespace frangia {

/// Measures the display and the camera of a project by `measure_display`, and writes what it found
/// into the project's rig.toml; the rig before is kept.
///
/// @errors   as open_devices, measure_display and with_display; rig.toml is then unchanged
[[nodiscard]] DisplayMeasurement measure_project_display(const ProjectFolder& project,
                                                         const CaptureSettings& settings,
                                                         const CaptureSetup& setup,
                                                         const Run& run);

}  // namespace frangia
