#pragma once

#include <map>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/run.h"
#include "frangia/reconstruct/internal/scan_targets.h"
#include "frangia/reconstruct/internal/split_setups.h"
#include "frangia/registration/register_views.h"
#include "frangia/rig/rig.h"

namespace frangia {

struct RegisterSetupsOptions {
  std::map<int, Eigen::Isometry3d> part_poses;  ///< approximate, of setups where it is known;
                                                ///< relative to the pose in setup 0
  bool refine = true;                           ///< all setups at once, after they are joined
  RegisterOptions registration;
  const ScanTargets* targets = nullptr;  ///< of the scan, where it has some
};

/// Joins the setups by their targets, by the shape of their surfaces, or by approximate part poses,
/// and refines all of them at once. A setup that cannot be joined is named in a warning and left
/// out.
///
/// @units    mm, the frame of the first setup, or of the first of the setups that fit together
/// @missing  `registration` of the result when it is not refined
[[nodiscard]] MeasuredSetup register_setups(std::vector<MeasuredSetup> setups,
                                            const Rig& rig,
                                            const RegisterSetupsOptions& options,
                                            const Run& run = {});

}  // namespace frangia
