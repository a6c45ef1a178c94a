#include "frangia/calibrate/internal/rig_covariance.h"

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "frangia/core/symmetric_eigen.h"
#include "frangia/rig/rig.h"
#include "frangia/rig/rig_covariance.h"

namespace frangia {
namespace {

/// Standard deviations of terms that are held at their nominal values: ordinary lenses and square
/// pixels. Zero: the parameter is always estimated.
constexpr std::array kHeldSigma = {0.0, 2e-3, 0.0, 0.0, 0.0, 0.1, 1e-3, 1e-3, 0.1};

/// Adds what is known beforehand of the terms that are held.
void add_priors(const std::array<bool, 9>& is_free, Eigen::Index first, Eigen::MatrixXd& normal) {
  for (std::size_t i = 0; i < is_free.size(); ++i) {
    const Eigen::Index row = first + static_cast<Eigen::Index>(i);
    if (!is_free.at(i)) normal(row, row) += 1.0 / (kHeldSigma.at(i) * kHeldSigma.at(i));
  }
}

}  // namespace

void add_covariance(std::span<const RigObservation> observations,
                    const RigFreedom& freedom,
                    const RigNoise& noise,
                    const RigParameters& parameters,
                    RigSolution& solution) {
  constexpr double kOpen = 1e-12;
  RigFreedom all = freedom;  // a held term is uncertain, too, and correlated with the others
  all.camera.fill(true);
  all.projector.fill(true);
  const Eigen::MatrixXd jacobian = linearize_rig(observations, all, noise, parameters).jacobian;
  Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
  add_priors(freedom.camera, 0, normal);
  add_priors(freedom.projector, kIntrinsics, normal);
  const Eigen::VectorXd scale =
      normal.diagonal().cwiseSqrt().unaryExpr([](double s) { return s > 0.0 ? 1.0 / s : 0.0; });
  const auto eigen =
      symmetric_eigen(Eigen::MatrixXd(scale.asDiagonal() * normal * scale.asDiagonal()));
  const double least = kOpen * eigen.values.tail<1>()[0];

  Rig rig;
  rig.projector.model = solution.projector;
  solution.parameters = rig_parameter_names(rig);
  const auto kept = static_cast<Eigen::Index>(solution.parameters.size());
  Eigen::VectorXd open = Eigen::VectorXd::Zero(normal.rows());
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(normal.rows(), normal.rows());
  for (Eigen::Index i = 0; i < eigen.values.size(); ++i) {
    const Eigen::VectorXd direction = eigen.vectors.col(i);
    if (eigen.values[i] > least) {
      inverse += direction * direction.transpose() / eigen.values[i];
    } else {
      open += direction.cwiseAbs2();
    }
  }
  const Eigen::MatrixXd scaled = scale.asDiagonal() * inverse * scale.asDiagonal();
  solution.covariance = scaled.topLeftCorner(kept, kept);
  constexpr double kMuch = 0.1;  // share of a parameter that lies in open directions
  for (Eigen::Index i = 0; i < kept; ++i) {
    if (open[i] < kMuch) continue;
    solution.undetermined.push_back(solution.parameters[static_cast<std::size_t>(i)]);
    solution.covariance(i, i) = std::numeric_limits<double>::infinity();
  }
}

}  // namespace frangia
