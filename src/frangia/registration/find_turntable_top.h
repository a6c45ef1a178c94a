#pragma once

#include <optional>

#include <Eigen/Geometry>

#include "frangia/core/angles.h"
#include "frangia/core/run.h"
#include "frangia/rig/camera_model.h"
#include "frangia/views/view_store.h"

namespace frangia {

struct TurntableTopOptions {
  double max_tilt_rad = rad_from_deg(3.0);  ///< of the turntable top against the axis
  double min_share = 0.03;                  ///< of all points that lie on it
  double max_below = 0.02;  ///< of as many points, that lie below it and within its rim
  double min_visible_edge =
      0.6;  ///< share of the directions about the axis in which its rim is seen
  double max_height_mm =
      3.0;  ///< above or below the origin; a disc that is higher must be min_width_ratio
  double min_width_ratio =
      1.5;  ///< times as min_width_ratio as all that stands on it: else it is a base
  double max_edge_variation = 0.05;  ///< of its radius, that the rim varies by
};

/// The top of the turntable: level, round about the axis, and with nothing below but its own rim.
///
/// A round base or flange of the part is all that, too, so a turntable top is also at the height of
/// the rig's origin, or much wider than what stands on it. A flange at that height on a table too
/// dark to be seen is all that, too: whoever drops what was found says so. units    mm, object
/// frame, as far as the poses of the views are known; the normal is up missing  nothing when no
/// plane is all that
[[nodiscard]] std::optional<Eigen::Hyperplane<double, 3>> find_turntable_top(
    const ViewStore& views,
    const CameraModel& camera,
    const TurntableTopOptions& options = {},
    const Run& run = {});

}  // namespace frangia
