#pragma once

#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/reconstruct/reconstruct.h"
#include "frangia/registration/refine_rig.h"

namespace frangia {

/// Refines the rig of a scan by the surfaces of its own views.
///
/// Of a scan with both directions of fringes each is triangulated by itself: how well both agree at
/// a pixel says more about projector and camera than any overlap of views. Further cameras stay
/// where they are; a warning names one whose surfaces do not agree with the refined rig.
///
/// @units    mm, rad
/// @errors   those of the stages from frames to points, and of `refine_rig`
[[nodiscard]] RigRefinement refine_scan_rig(const Scan& scan,
                                            const ReconstructOptions& options = {},
                                            const Run& run = {});

}  // namespace frangia
