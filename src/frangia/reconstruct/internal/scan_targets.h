#pragma once

#include <map>
#include <string>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/reconstruct/internal/measure_views.h"
#include "frangia/registration/point_tie.h"
#include "frangia/rig/target_set.h"
#include "frangia/targets/match_targets.h"

namespace frangia {

/// What all views of a scan saw of its targets.
struct ScanTargets {
  TargetSet set;
  std::map<std::string, std::vector<TargetSighting>> sightings;  ///< by the name of the station
};

/// Finds the targets in the white or mean frames of all views, by the reference camera.
///
/// @errors   Error(Input) in a build without calibration, and as read_frames
[[nodiscard]] ScanTargets find_scan_targets(const Scan& scan,
                                            const MeasuredViews& measured,
                                            const Run& run);

/// What these views saw, where they are now.
[[nodiscard]] std::vector<TargetView> target_views(const ScanTargets& targets,
                                                   const MeasuredViews& measured);

/// The ties of views that saw the same targets.
///
/// @errors   Error(Input) when two targets have one code
[[nodiscard]] std::vector<PointTie> target_ties(const ScanTargets& targets,
                                                const MeasuredViews& measured);

}  // namespace frangia
