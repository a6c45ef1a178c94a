#pragma once

#include <optional>

#include <Eigen/Geometry>

#include "frangia/core/angles.h"
#include "frangia/core/run.h"
#include "frangia/rig/lens.h"
#include "frangia/views/view_store.h"

namespace frangia {

struct PlatterOptions {
  double max_tilt_rad = rad_from_deg(3.0);  ///< of the platter against the axis
  double min_share = 0.03;                  ///< of all points that lie on it
  double max_below = 0.02;                  ///< of as many points, that lie below it
  double min_round = 0.6;  ///< share of the directions about the axis in which it is seen
};

/// The plane of the turntable that the part stands on: level, seen all around the axis, and with
/// nothing below. A flat part of the object has its own sides below it.
///
/// units    mm, object frame, as far as the poses of the views are known; the normal is up
/// missing  nothing when no plane is all that
[[nodiscard]] std::optional<Eigen::Hyperplane<double, 3>> find_platter(
    const ViewStore& views,
    const Lens& camera,
    const PlatterOptions& options = {},
    const Run& run = {});

}  // namespace frangia
