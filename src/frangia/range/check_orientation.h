#pragma once

#include <string>

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/phase/wrap/phase_map.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// Whether the phase rises in the direction of the image in which the rig places rising phases.
///
/// Along a surface that faces camera and projector, the projector's columns appear in their own
/// order, whatever the shape of the surface. Shifts in the opposite direction in all patterns, a
/// mirrored projector or camera, and rows that are exchanged with columns break this rule, although
/// the patterns agree with each other.
struct OrientationCheck {
  bool decided = false;    ///< enough pixels agree on a direction
  bool consistent = true;  ///< the direction is that of the rig, or it is not decided
  double rising = 0.0;  ///< share of the pixels whose phase rises where the rig says that it does
  double across = 0.0;  ///< change across the direction of the rig, over the change along it
  std::string fits{};   ///< what would fit, as a clause; empty if consistent
};

/// Compares the gradient of a phase, absolute or wrapped, with that of a plane at the distance
/// where the axes of camera and projector cross.
///
/// @shape    `rays` as rays_of(rig.reference().model)
/// @missing  not decided for few pixels, or where less than 80 % of them agree
[[nodiscard]] OrientationCheck check_orientation(const AbsolutePhase& phase,
                                                 const Rig& rig,
                                                 const Image<Eigen::Vector2f>& rays);

}  // namespace frangia
