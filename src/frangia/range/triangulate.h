#pragma once

#include <Eigen/Core>

#include "frangia/core/image.h"
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

}  // namespace frangia
