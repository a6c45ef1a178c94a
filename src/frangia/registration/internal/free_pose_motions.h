#pragma once

#include "frangia/registration/internal/free_pose_bundle.h"
#include "frangia/registration/view_motions.h"

namespace frangia {

/// How the poses of free views may be wrong by what their pairs leave open, in independent changes
/// of one standard deviation.
///
/// @shape    one for each view; that of view 0, whose pose is held, is 0
/// @units    `prior_mm`: standard deviation of the given poses, as the way of a view's points
[[nodiscard]] ViewMotions motions_of_free_poses(const FreePoseBundle& bundle,
                                                const FreePoseSums& sums,
                                                double prior_mm);

}  // namespace frangia
