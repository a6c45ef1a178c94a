#pragma once

#include <span>
#include <vector>

#include "frangia/fusion/fuse_views.h"
#include "frangia/reconstruct/internal/register_setups.h"
#include "frangia/rig/rig.h"
#include "frangia/views/view_store.h"

namespace frangia {

/// Sets the poses of the further cameras' views from those of the reference camera's and the poses
/// of the cameras in the rig.
void tie_cameras(MeasuredViews& measured, const Rig& rig);

/// Empties the views of all cameras that the registration of a setup emptied.
void clear_outliers_of_cameras(MeasuredSetup& setup);

/// Collects the points of all cameras, as `collect_points` does for one. `terms` get each
/// view with the index of its camera.
[[nodiscard]] PointCloud collect_points_of_cameras(const std::vector<CameraViews>& cameras,
                                                   const Run& run,
                                                   std::span<const SigmaTerm> terms);

/// The views of all cameras, the reference camera first. `measured` and `rig` must outlive them.
[[nodiscard]] std::vector<CameraViews> views_of_cameras(const MeasuredViews& measured,
                                                        const Rig& rig);

}  // namespace frangia
