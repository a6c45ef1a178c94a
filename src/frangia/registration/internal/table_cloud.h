#pragma once

#include <vector>

#include <Eigen/Core>

#include "frangia/core/run.h"
#include "frangia/rig/camera_model.h"
#include "frangia/views/view_store.h"

namespace frangia {

/// Points of all views.
///
/// @units    mm, object frame
struct TableCloud {
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3d> normals;  ///< unit, one a point
  double sigma_mm = 0.0;                 ///< median, along the normal
  double working_distance_mm = 0.0;      ///< median distance of the points from the camera
};

/// About 20000 points of each view, or fewer of more than 24 views.
[[nodiscard]] TableCloud gather_table_cloud(const ViewStore& views,
                                            const CameraModel& camera,
                                            const Run& run);

/// How far from the axis the points above a height reach, except for the farthest hundredth. 0 when
/// there are none.
[[nodiscard]] double reach_above(const std::vector<Eigen::Vector3d>& points, double height_mm);

}  // namespace frangia
