#pragma once

#include <cstddef>

#include "frangia/pattern/pattern.h"
#include "frangia/range/depth_agreement.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// What the covariance of the rig adds to the difference between the points of two directions of
/// fringes, along the ray of the reference camera.
///
/// @missing  empty where the rig states no uncertainty of its calibration. Without a covariance it
///           is that of two points of `point_sigma_mm`
/// @source   GUM (JCGM 100:2008), 5.2
[[nodiscard]] DifferenceUncertainty between_directions(const Rig& rig,
                                                       const Pattern& first,
                                                       const Pattern& second);

/// The same for the points of two cameras, along the ray of camera `own`; with a projector that is
/// a label, for the distance of their rays. Cameras count as in `rig_of_camera`; the points are in
/// the frame of camera `own`.
[[nodiscard]] DifferenceUncertainty between_cameras(const Rig& rig,
                                                    const Pattern& pattern,
                                                    std::size_t own,
                                                    std::size_t other);

}  // namespace frangia
