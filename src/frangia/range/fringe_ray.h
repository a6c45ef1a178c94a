#pragma once

#include <Eigen/Core>

#include "frangia/pattern/pattern.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// The depth of a point on a camera ray and its derivative with respect to the phase.
struct RayDepth {
  double depth_mm = 0.0;    ///< z of the point; NaN without an intersection in front of the camera
  double mm_per_rad = 0.0;  ///< d depth / d phase
};

/// Intersects the camera ray through the normalized image point (x/z, y/z) with the projector's
/// surface of constant absolute phase.
///
/// @units    rad in, mm and mm/rad out; rig frame
/// @missing  NaN where ray and surface do not intersect in front of camera and projector
/// @source   the paper's equations (5) to (8), applied to the ray of any pixel
[[nodiscard]] RayDepth intersect_fringe(const Eigen::Vector2d& ray,
                                        double phase_rad,
                                        const Pattern& pattern,
                                        const Projector& projector);

/// Computes the absolute phase that the projector shows at a point of the rig frame.
///
/// @units    mm in, rad out
/// @missing  NaN for a point behind the projector
[[nodiscard]] double phase_at(const Eigen::Vector3d& point_mm,
                              const Pattern& pattern,
                              const Projector& projector);

}  // namespace frangia
