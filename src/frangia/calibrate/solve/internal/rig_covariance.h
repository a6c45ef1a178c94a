#pragma once

#include <span>
#include <string>
#include <vector>

#include "frangia/calibrate/internal/rig_bundle.h"
#include "frangia/calibrate/solve/solve_rig.h"

namespace frangia {

/// Adds the covariance of cameras, projector and relative poses to a solution, with the poses and
/// the board's shape marginalized, and names the parameters that the data do not determine. Terms
/// of the lenses that are held have the uncertainty that ordinary lenses leave, so that it enters
/// the parameters that would compensate them.
///
/// @shape    `names` are those of all parameters of the layout but the board's
/// @units    focal lengths and principal points px, rotation rad, translation mm
/// @missing  a parameter that is not determined has an infinite variance
/// @source   inverse of the normal equations; a direction whose eigenvalue is below 1e-12 of the
///           largest, in parameters scaled to unit diagonal, counts as not determined
void add_covariance(std::span<const RigObservation> observations,
                    const RigFreedom& freedom,
                    const RigNoise& noise,
                    const RigParameters& parameters,
                    const std::vector<std::string>& names,
                    RigSolution& solution);

}  // namespace frangia
