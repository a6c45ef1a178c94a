#pragma once

#include <cstdint>

#include <Eigen/Geometry>

#include "frangia/rig/rig.h"
#include "frangia/simulate/simulate_options.h"

namespace frangia {

/// Pose of the part in a view, with the faults of table and part.
///
/// @units    `angle_rad`: of the table, commanded, with its error
[[nodiscard]] Eigen::Isometry3d pose_with_motion(const Rig& rig,
                                                 double angle_rad,
                                                 std::size_t view,
                                                 const MotionFaults& faults,
                                                 std::uint64_t seed);

/// The projector after a share of its drift.
[[nodiscard]] Projector drift(Projector projector, double drift_mm, double share);

}  // namespace frangia
