#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "frangia/core/run.h"
#include "frangia/service/capture_settings.h"
#include "frangia/service/project_folder.h"
#include "frangia/service/project_scan.h"

namespace frangia {

/// Light and focus before a scan, measured in one view.
struct ScanCheck {
  std::int64_t at_s = 0;  ///< when it was captured, seconds since 1970
  /// Of the finest fringes, 0 to 1: light and focus together; of several directions the least.
  double contrast = 0.0;
  double saturated = 0.0;  ///< share of all pixels, 0 to 1; of several directions the largest
  std::size_t points = 0;  ///< measured pixels
  std::string finding;     ///< what its frames lack, one sentence; empty when they are good
};

/// Captures one view at the start of the turntable with the settings of the scan and decodes it.
///
/// @errors   as open_devices and preview; Error(Input) for a rig that is not calibrated
[[nodiscard]] ScanCheck check_scan(const ProjectFolder& project,
                                   const CaptureSettings& settings,
                                   const CaptureSetup& setup,
                                   const Run& run);

}  // namespace frangia
