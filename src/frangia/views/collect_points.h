#pragma once

#include <vector>

#include <Eigen/Core>

#include "frangia/core/run.h"
#include "frangia/rig/camera_model.h"
#include "frangia/views/view_store.h"

namespace frangia {

/// Measured points of all views, as they are: not smoothed, not averaged.
///
/// units    mm, object frame
struct PointCloud {
  std::vector<Eigen::Vector3f> points_mm;
  std::vector<float> sigma_mm;  ///< along the viewing ray, one a point
};

/// View by view, row by row.
[[nodiscard]] PointCloud collect_points(const ViewStore& views,
                                        const CameraModel& camera,
                                        const Run& run = {});

}  // namespace frangia
