#pragma once

#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/decode/plan_decoding.h"

namespace frangia {

/// Checks before the work that the rig of a scan can measure what its frames show: its views can be
/// brought together, its fringes move with depth, and its patterns determine the fringe orders.
/// Warns where distances are relative only.
///
/// @errors   Error(Input), with what to capture or to state in rig.toml
void check_geometry(const Scan& scan, const DecodePlan& plan, const Run& run);

}  // namespace frangia
