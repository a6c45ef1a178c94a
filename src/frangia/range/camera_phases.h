#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/image.h"
#include "frangia/phase/wrap/phase_map.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// What one of several cameras measured in a view.
///
/// @shape    `rays` as rays_of(rig.reference().model); `phases` one or two, those of the same
///           directions of fringes in the same order for all cameras of a view
struct CameraPhases {
  const Rig& rig;                              ///< `rig_of_camera` of this camera
  const Image<Eigen::Vector2f>& rays;          ///< of its pixels
  Eigen::Isometry3d camera_from_rig;           ///< from the frame of the reference camera
  std::vector<const AbsolutePhase*> phases{};  ///< one for each direction of fringes
};

}  // namespace frangia
