#pragma once

#include <Eigen/Core>

#include "frangia/pattern/pattern.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// A depth along a camera ray, and how fast it moves with the phase.
struct RayDepth {
  double depth_mm = 0.0;    ///< z of the point; NaN when ray and fringe meet nowhere in front
  double mm_per_rad = 0.0;  ///< d depth / d phase
};

/// Where the camera ray through the normalized point (x/z, y/z) meets the surface of light of one
/// absolute phase.
///
/// source   the paper's equations (5) to (8), along the ray of any pixel instead of a section's
[[nodiscard]] RayDepth intersect_fringe(const Eigen::Vector2d& ray,
                                        double phase_rad,
                                        const Pattern& pattern,
                                        const Projector& projector);

/// The absolute phase with which a point of the rig frame is lit; NaN where it is not.
[[nodiscard]] double phase_at(const Eigen::Vector3d& point_mm,
                              const Pattern& pattern,
                              const Projector& projector);

}  // namespace frangia
