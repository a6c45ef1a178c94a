#pragma once

#include <vector>

#include "frangia/acquisition/internal/capture_devices.h"
#include "frangia/acquisition/internal/exposure_search.h"
#include "frangia/dataset/scan_folder.h"

namespace frangia {

/// Looks at up to four views, evenly over the plan, for the exposures that they need: one, or as
/// many as a bracket takes, the one that measures most first.
///
/// units    ms
/// errors   Error(Input) without a pattern of fringes, and what the devices throw
[[nodiscard]] std::vector<double> survey_exposures(const Scan& plan,
                                                   CaptureDevices& devices,
                                                   const CaptureOptions& options,
                                                   ExposureRange range,
                                                   const Run& run);

}  // namespace frangia
