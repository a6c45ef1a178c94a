#pragma once

#include <ceres/problem.h>
#include <ceres/solver.h>

namespace frangia {

/// Solves a problem without a word on stderr. Ceres' Levenberg-Marquardt steps warn through glog of
/// each matrix that is not positive definite whatever `logging_type` is; the solver then takes a
/// shorter step, and the summary tells how it ended.
///
/// glog has one level for the process: it is raised while a problem is solved, also for solutions
/// at the same time, and set back afterwards.
[[nodiscard]] ceres::Solver::Summary solve_quietly(ceres::Solver::Options options,
                                                   ceres::Problem& problem);

}  // namespace frangia
