#pragma once

#include <vector>

#include "frangia/acquisition/internal/capture_devices.h"
#include "frangia/acquisition/internal/exposure_search.h"
#include "frangia/acquisition/internal/table_mover.h"
#include "frangia/dataset/scan_folder.h"

namespace frangia {

/// Chooses exposures from up to four views, evenly over the plan: one exposure, or a bracket in the
/// order of the pixels that each adds.
///
/// @units    ms
/// @errors   Error(Input) without a pattern of fringes, and those of the devices
[[nodiscard]] std::vector<double> survey_exposures(const Scan& plan,
                                                   CaptureDevices& devices,
                                                   TableMover& table,
                                                   const CaptureOptions& options,
                                                   ExposureRange range,
                                                   const Run& run);

}  // namespace frangia
