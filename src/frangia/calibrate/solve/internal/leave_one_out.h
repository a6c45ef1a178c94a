#pragma once

#include <span>

#include <Eigen/Core>

#include "frangia/calibrate/internal/rig_bundle.h"
#include "frangia/calibrate/solve/solve_rig.h"

namespace frangia {

/// Adds `leave_one_out_mm` and `spread_mm` to a solution.
///
/// @shape    `response` as `shape_response` returns it
/// @source   one Gauss-Newton step from the solution of all poses to that of all but one; the
///           jackknife, Tukey 1958, for the spread
void add_leave_one_out(std::span<const RigObservation> observations,
                       const RigFreedom& freedom,
                       const RigNoise& noise,
                       const RigParameters& parameters,
                       const Eigen::MatrixXd& response,
                       RigSolution& solution);

}  // namespace frangia
