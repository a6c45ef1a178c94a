#pragma once

#include "frangia/dataset/scan_folder.h"

namespace frangia {

/// The plan of a scan in which the part is clamped anew: the views of `plan` become those of
/// `setup`, and the views of the other setups come from the capture that `plan.folder` holds. The
/// folders of new views are numbered behind the stored ones.
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
