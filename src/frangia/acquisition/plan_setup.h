#pragma once

#include "frangia/dataset/scan_folder.h"

namespace frangia {

/// Plans a further setup of a scan, in which the part is turned over or moved. The views of `plan`
/// become those of `setup`; those of the other setups are read from the capture in `plan.folder`.
/// The folders of new views continue the numbers of the stored ones. Views that were added to this
/// setup behind those of `plan`, at other angles of the turntable, stay.
///
/// The plan of setup 0 of a new folder is `plan` itself. A setup that was begun is continued by the
/// same plan. `CaptureOptions::setup` names the setup to capture.
///
/// @errors   Error(Input) when an earlier setup is missing or not captured; as read_scan
[[nodiscard]] Scan plan_setup(const Scan& plan, int setup);

/// The number of the last setup that the capture in a scan folder planned; 0 without a capture.
///
/// @errors   as read_scan
[[nodiscard]] int last_setup(const std::filesystem::path& scan_folder);

}  // namespace frangia
