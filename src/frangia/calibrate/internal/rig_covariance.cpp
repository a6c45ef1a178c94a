#include "frangia/calibrate/internal/rig_covariance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "frangia/core/symmetric_eigen.h"

namespace frangia {
namespace {

/// Standard deviations of terms that are held at their nominal values: ordinary lenses and square
/// pixels. Zero: the parameter is always estimated.
constexpr std::array kHeldSigma = {0.0, 2e-3, 0.0, 0.0, 0.0, 0.1, 1e-3, 1e-3, 0.1};

/// Adds what is known beforehand of the terms of a device that are held.
void add_priors(const RigFreedom& freedom, std::size_t first, Eigen::MatrixXd& normal) {
  for (std::size_t i = 0; i < kHeldSigma.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(first + i);
    if (!freedom.free.at(first + i))
      normal(row, row) += 1.0 / (kHeldSigma.at(i) * kHeldSigma.at(i));
  }
}

}  // namespace

void add_covariance(std::span<const RigObservation> observations,
                    const RigFreedom& freedom,
                    const RigNoise& noise,
                    const RigParameters& parameters,
                    const std::vector<std::string>& names,
                    RigSolution& solution) {
  constexpr double kOpen = 1e-12;
  const RigLayout& layout = freedom.layout;
  RigFreedom all = freedom;  // a held term is uncertain, too, and correlated with the others
  std::fill_n(all.free.begin(), layout.board(), true);
  const RigLinearization full = linearize_rig(observations, layout, noise, parameters);
  const Eigen::MatrixXd jacobian =
      full.jacobian(Eigen::all, free_columns(all, full.jacobian.cols()));
  Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
  add_priors(freedom, 0, normal);
  if (layout.has_projector) add_priors(freedom, layout.projector(), normal);
  for (std::size_t i = 0; i < layout.more; ++i)
    add_priors(freedom, layout.camera(i), normal);
  const Eigen::VectorXd scale =
      normal.diagonal().cwiseSqrt().unaryExpr([](double s) { return s > 0.0 ? 1.0 / s : 0.0; });
  const auto eigen =
      symmetric_eigen(Eigen::MatrixXd(scale.asDiagonal() * normal * scale.asDiagonal()));
  const double least = kOpen * eigen.values.tail<1>()[0];

  solution.parameters = names;
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
