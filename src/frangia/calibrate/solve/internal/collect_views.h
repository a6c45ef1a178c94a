#pragma once

#include "frangia/calibrate/solve/calibrate_rig.h"
#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"

namespace frangia {

/// Measures the board in all views by all cameras, checks the poses, and returns a calibration with
/// those that are usable, without its solution. A pose that the reference camera does not see is
/// not used; another camera may miss some.
///
/// @errors   as `check_board_views`; those of a further camera name it
[[nodiscard]] RigCalibration collect_board_views(const Scan& scan,
                                                 const CalibrateRigOptions& options,
                                                 const Run& run);

}  // namespace frangia
