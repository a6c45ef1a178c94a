#pragma once

#include <vector>

#include "frangia/dataset/scan_folder.h"

namespace frangia {

/// When the views of a scan were taken, by the manifest of its capture: means over the frames of
/// each, in seconds since the scan began.
///
/// @shape    one for each of `scan.views`
/// @missing  NaN for a view of which the manifest states no times, as those of older captures and
///           of imported scans
[[nodiscard]] std::vector<double> read_capture_times(const Scan& scan);

/// When the capture of a scan began, by its manifest: seconds since 1970, UTC.
///
/// @missing  NaN without a manifest that states it
[[nodiscard]] double read_capture_begin(const Scan& scan);

}  // namespace frangia
