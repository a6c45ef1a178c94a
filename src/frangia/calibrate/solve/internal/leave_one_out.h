#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "frangia/calibrate/internal/rig_bundle.h"

namespace frangia {

/// How far the triangulated points move when one pose is left out; see `RigSolution`.
struct LeaveOneOut {
  std::vector<double> by_view_mm;
  double spread_mm = 0.0;
};

/// Leaves out each pose in turn.
///
/// @shape    `response` as `shape_response` returns it
/// @source   one Gauss-Newton step from the solution of all poses to that of all but one; the
///           jackknife, Tukey 1958, for the spread
[[nodiscard]] LeaveOneOut leave_one_out(std::span<const RigObservation> observations,
                                        const RigFreedom& freedom,
                                        const RigNoise& noise,
                                        const RigParameters& parameters,
                                        const Eigen::MatrixXd& response);

}  // namespace frangia
