#pragma once

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/pattern/pattern.h"
#include "frangia/phase/wrap/phase_map.h"
#include "frangia/range/range_grid.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// Triangulates each pixel from its camera ray and its absolute phase.
///
/// @shape    w x h in and out; `rays` from `rays_of(rig.reference().model)`
/// @units    mm, rig frame; sigma and systematic part along the viewing ray
/// @missing  without `phase.systematic_rad` the result has no systematic part;
///           a pixel without a phase has no point; a pixel whose phase the projector does not show
///          in front of the camera has none either and is marked OutOfField in `phase`
/// @errors   Error(Input) when the phase and the rays differ in size
/// @source   the paper's equations (5) to (8)
[[nodiscard]] RangeGrid triangulate(AbsolutePhase& phase,
                                    const Rig& rig,
                                    const Image<Eigen::Vector2f>& rays);

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
