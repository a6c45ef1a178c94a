#pragma once

#include "frangia/calibrate/internal/rig_model.h"
#include "frangia/calibrate/solve_rig.h"

namespace frangia {

/// Adds `point_sigma_mm` and `distance_mm` to a solution that has its covariance.
///
/// @source   linear propagation: a point is where the ray of a camera pixel meets the sheet of
///           light of one projector column. Rigid motions of all points of all poses together are
///           removed, because they do not change a measured shape; a change of scale counts.
void add_point_sigma(const Board& board, const RigParameters& parameters, RigSolution& solution);

}  // namespace frangia
