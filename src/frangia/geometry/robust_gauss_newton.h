#pragma once

#include <functional>

#include <Eigen/Core>

#include "frangia/core/run.h"

namespace frangia {

/// Tukey's biweight, which is 1 for a residual of 0 and falls to 0 at the gate.
///
/// @units    `residual` and `gate` in the same unit
/// @source   Beaton & Tukey 1974
[[nodiscard]] inline double tukey_weight(double residual, double gate) {
  const double ratio = residual / gate;
  const double complement = 1.0 - ratio * ratio;
  return complement > 0.0 ? complement * complement : 0.0;
}

/// The derivative of a weighted residual, `residual * tukey_weight(residual, gate)`.
///
/// The covariance of an estimate has this slope, not the weight, in the inverse of its sandwich: an
/// error of many residuals moves their weights, too. At 4.685 standard deviations the weight alone
/// would understate the standard uncertainty by a sixth.
///
/// @units    `residual` and `gate` in the same unit
/// @source   Huber 1981, Robust Statistics, 7.6
[[nodiscard]] inline double tukey_slope(double residual, double gate) {
  const double square = residual * residual / (gate * gate);
  return square < 1.0 ? (1.0 - square) * (1.0 - 5.0 * square) : 0.0;
}

/// The gate at 4.685 robust standard deviations (1.4826 medians) of the absolute residuals, where
/// Tukey's biweight has 95 % of the efficiency of least squares.
[[nodiscard]] double gate_of_median(double median_residual);

/// A nonlinear least-squares problem, linearized at its current state.
///
/// @shape    n unknowns: `hessian` n x n, `gradient` n
struct Linearization {
  Eigen::MatrixXd hessian;       ///< sum of w J^T J, and the information of a prior if there is one
  Eigen::VectorXd gradient;      ///< sum of w J^T r, and the gradient of a prior if there is one
  double median_residual = 0.0;  ///< of the absolute residuals within the gate
  double unit_weight_sigma = 1.0;  ///< standard deviation of a residual of weight 1
  bool solvable = true;            ///< false when too few residuals lie within the gate
};

/// Residuals and their Jacobian at a state that the problem keeps itself.
struct RobustProblem {
  /// Weights each residual by `tukey_weight(residual, gate)` over its variance.
  std::function<Linearization(double gate)> linearize;
  /// Moves the state by a step in the unknowns.
  std::function<void(const Eigen::VectorXd& step)> update;
};

/// Gate, stopping rule and damping of `minimize_robustly`.
struct GaussNewtonOptions {
  double gate = 0.0;        ///< of the first iteration, in the unit of the residuals; required
  double min_gate = 0.0;    ///< the gate never closes further
  int max_iterations = 30;  ///< each linearizes once
  double tolerance = 0.01;  ///< of the last step, in standard deviations of the estimate
  double damping = 1e-9;    ///< added to each diagonal element, as a share of it: directions that
                            ///< the residuals do not determine keep their values

  /// @errors   Error(Input) that names the value which is out of its range
  void check() const;
};

/// How `minimize_robustly` ended.
struct GaussNewtonResult {
  int iterations = 0;      ///< number of linearizations
  double gate = 0.0;       ///< of the last iteration
  bool converged = false;  ///< by the stopping rule, before `max_iterations`
};

/// Minimizes the robust sum of squares of a problem by iteratively reweighted Gauss-Newton.
///
/// After each step the gate closes to `gate_of_median` of the residuals. The iteration stops when
/// the gate closes by less than 10 % and the step is shorter than `tolerance` standard deviations
/// of the estimate in every direction: sqrt(d^T H d) < tolerance * unit_weight_sigma. The equations
/// are scaled to a unit diagonal before they are solved, so that the result does not depend on the
/// units of the unknowns.
///
/// @errors   Error(Input) as `GaussNewtonOptions::check`; Error(Cancelled) when `run` is cancelled
/// @source   Holland & Welsch 1977
GaussNewtonResult minimize_robustly(const RobustProblem& problem,
                                    const GaussNewtonOptions& options,
                                    const Run& run = {});

}  // namespace frangia
