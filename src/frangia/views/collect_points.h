#pragma once

#include <vector>

#include <Eigen/Core>

#include "frangia/core/run.h"
#include "frangia/rig/camera_model.h"
#include "frangia/views/view_store.h"

namespace frangia {

/// Measured points of all views, neither smoothed nor averaged.
///
/// @units    mm, object frame
struct PointCloud {
  std::vector<Eigen::Vector3f> points_mm;  ///< positions
  std::vector<float> sigma_mm;  ///< standard deviation of each point along its viewing ray
};

/// Collects the points of all views, view by view and row by row, without edge pixels.
///
/// @units    mm, object frame
/// @missing  missing pixels are skipped
/// @errors   Error(Input) when a view and the camera differ in size
[[nodiscard]] PointCloud collect_points(const ViewStore& views,
                                        const CameraModel& camera,
                                        const Run& run = {});

}  // namespace frangia
