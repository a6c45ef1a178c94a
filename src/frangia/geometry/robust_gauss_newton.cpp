#include "frangia/geometry/robust_gauss_newton.h"

#include <algorithm>
#include <cmath>

#include "frangia/core/error.h"
#include "frangia/core/linear_algebra.h"

namespace frangia {
namespace {

constexpr double kTukeyConstant = 4.685;     // 95 % efficiency for normal residuals
constexpr double kSigmaFromMedian = 1.4826;  // of the absolute values of normal residuals
constexpr double kGateConverged = 0.9;       // of the previous gate

/// The Gauss-Newton step, by equations with a unit diagonal.
Eigen::VectorXd solve_step(const Linearization& at, double damping) {
  const Eigen::VectorXd diagonal = at.hessian.diagonal();
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(diagonal.size());
  for (Eigen::Index i = 0; i < diagonal.size(); ++i) {
    if (diagonal[i] > 0.0) scale[i] = 1.0 / std::sqrt(diagonal[i]);
  }
  Eigen::MatrixXd scaled = scale.asDiagonal() * at.hessian * scale.asDiagonal();
  scaled.diagonal().array() += damping;
  // An unknown that no residual depends on keeps its value.
  for (Eigen::Index i = 0; i < scaled.rows(); ++i) {
    if (!(diagonal[i] > 0.0)) scaled(i, i) = 1.0;
  }
  return -scale.cwiseProduct(solve_symmetric(scaled, scale.cwiseProduct(at.gradient)));
}

}  // namespace

double gate_of_median(double median_residual) {
  return kTukeyConstant * kSigmaFromMedian * median_residual;
}

void GaussNewtonOptions::check() const {
  require(gate > 0.0, "GaussNewtonOptions: gate must be above 0");
  require(min_gate >= 0.0, "GaussNewtonOptions: min_gate must not be negative");
  require(max_iterations >= 1, "GaussNewtonOptions: max_iterations must be at least 1");
  require(tolerance > 0.0, "GaussNewtonOptions: tolerance must be above 0");
  require(damping >= 0.0, "GaussNewtonOptions: damping must not be negative");
}

GaussNewtonResult minimize_robustly(const RobustProblem& problem,
                                    const GaussNewtonOptions& options,
                                    const Run& run) {
  options.check();
  GaussNewtonResult result{0, options.gate, false};
  while (result.iterations < options.max_iterations && !result.converged) {
    run.check();
    const Linearization at = problem.linearize(result.gate);
    if (!at.solvable) break;
    const Eigen::VectorXd step = solve_step(at, options.damping);
    problem.update(step);
    ++result.iterations;
    const double closed = std::max(options.min_gate, gate_of_median(at.median_residual));
    const double length = std::sqrt(std::max(0.0, step.dot(at.hessian * step)));
    result.converged =
        closed > kGateConverged * result.gate && length < options.tolerance * at.unit_weight_sigma;
    // Residuals that are exactly 0 leave no gate to close to.
    if (closed > 0.0) result.gate = std::min(result.gate, closed);
  }
  return result;
}

}  // namespace frangia
