#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/geometry/mesh.h"
#include "frangia/reconstruct/internal/measure_views.h"
#include "frangia/reconstruct/internal/split_setups.h"
#include "frangia/reconstruct/reconstruct.h"
#include "frangia/reconstruct/targets_report.h"
#include "frangia/registration/point_tie.h"
#include "frangia/rig/rig.h"
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

/// The targets where the registered views put them.
///
/// @errors   Error(Input) when two targets have one code
[[nodiscard]] std::vector<Target> registered_targets(const ScanTargets& targets,
                                                     const MeasuredSetup& joined);

/// The report on targets. Warns of known distances that were not measured or that contradict each
/// other.
[[nodiscard]] TargetsReport report_targets(const std::vector<Target>& found,
                                           const ScanTargets& targets,
                                           const MeasuredSetup& joined,
                                           const std::vector<ViewSummary>& summaries,
                                           const Run& run);

/// Removes the points of all views on the stickers, and within two pixels of their edges, where the
/// fringes of two tones mix: a sticker is not the surface of the part. Returns their number.
std::size_t mask_targets(const std::vector<Target>& found,
                         const TargetSet& set,
                         MeasuredViews& measured,
                         const Rig& rig);

/// Closes the holes of a mesh under targets, whose triangles are marked as synthesized. Returns
/// their number.
std::size_t fill_targets(const std::vector<Target>& found,
                         const TargetSet& set,
                         Mesh& mesh,
                         const Run& run);

/// Scales what was reconstructed about the origin of the object frame.
void apply_scale(Reconstruction& result, double factor);

}  // namespace frangia
