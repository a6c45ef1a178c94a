#pragma once

#include <vector>

#include "frangia/acquisition/internal/capture_devices.h"
#include "frangia/acquisition/internal/capture_manifest.h"
#include "frangia/acquisition/internal/exposure_search.h"
#include "frangia/acquisition/internal/table_mover.h"
#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"

namespace frangia {

/// Exposures of a scan.
struct ChosenExposures {
  std::vector<double> fringes_ms;  ///< of the fringes, in the order of capture
  double single_ms = 0.0;          ///< of patterns without exposures of their own
};

/// Chooses the exposures for the whole scan, or takes those of an earlier session from the
/// manifest. Adds the exposures of a bracket to the patterns of `plan`.
///
/// @errors   Error(Input) when the manifest is damaged and lacks the exposures; those of the
/// devices
[[nodiscard]] ChosenExposures choose_exposures(Scan& plan,
                                               CaptureDevices& devices,
                                               const ExposureRange& range,
                                               TableMover& table,
                                               CaptureManifest& manifest,
                                               const CaptureOptions& options,
                                               const Run& run);

}  // namespace frangia
