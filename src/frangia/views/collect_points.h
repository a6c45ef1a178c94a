#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/run.h"
#include "frangia/rig/camera_model.h"
#include "frangia/views/sigma_terms.h"
#include "frangia/views/view_store.h"

namespace frangia {

/// Measured points of all views, neither smoothed nor averaged.
///
/// @units    mm, object frame
struct PointCloud {
  std::vector<Eigen::Vector3f> points_mm;  ///< positions
  std::vector<float> sigma_mm;  ///< noise of each point, standard deviation along its viewing ray
  /// Systematic standard uncertainty of each point along its viewing ray; empty when none is known.
  std::vector<float> systematic_mm;
};

/// Collects the points of all views, view by view and row by row, without edge pixels.
/// `terms`: systematic parts that are not stored with the views of this `camera_index`.
///
/// @units    mm, object frame
/// @missing  missing pixels are skipped
/// @errors   Error(Input) when a view and the camera differ in size
[[nodiscard]] PointCloud collect_points(const ViewStore& views,
                                        const CameraModel& camera,
                                        const Run& run = {},
                                        std::span<const SigmaTerm> terms = {},
                                        std::size_t camera_index = 0);

}  // namespace frangia
