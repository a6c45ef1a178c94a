#include "frangia/registration/internal/sum_ties.h"

#include <algorithm>
#include <cmath>

#include "frangia/core/linear_algebra.h"
#include "frangia/registration/internal/view_transfer.h"

namespace frangia {
namespace {

/// The derivatives of a distance by all unknowns.
Eigen::VectorXd row_of(const PairJacobian& by,
                       const TableState& state,
                       std::size_t from,
                       std::size_t to) {
  Eigen::VectorXd row = Eigen::VectorXd::Zero(state.unknowns());
  row.head<2>() = by.tilt;
  row.segment<2>(2) = by.shift;
  if (to != 0) row[static_cast<Eigen::Index>(to) + 3] += by.angle_to;
  if (from != 0) row[static_cast<Eigen::Index>(from) + 3] += by.angle_from;
  const std::size_t setup_to = state.setup_of(to);
  const std::size_t setup_from = state.setup_of(from);
  if (setup_to == setup_from) return row;
  if (setup_to != 0) row.segment<6>(state.index_of_setup(setup_to)) += by.setup_to;
  if (setup_from != 0) row.segment<6>(state.index_of_setup(setup_from)) += by.setup_from;
  return row;
}

}  // namespace

double TieSums::excess() const {
  return freedom > 0.0 ? std::max(1.0, std::sqrt(chi_squared / freedom)) : 1.0;
}

TieSums sum_ties(std::span<const PointTie> ties, const TableState& state) {
  constexpr double kSigmas = 4.0;
  TieSums sums{Eigen::MatrixXd::Zero(state.unknowns(), state.unknowns()),
               Eigen::VectorXd::Zero(state.unknowns())};
  for (const PointTie& tie : ties) {
    const ViewTransfer transfer(state, tie.from, tie.to);
    const Eigen::Matrix3d covariance =
        transfer.rotation() * tie.from_covariance_mm2 * transfer.rotation().transpose() +
        tie.to_covariance_mm2;
    const SymmetricEigen<3> own = symmetric_eigen(covariance);
    const Eigen::Vector3d away =
        own.vectors.transpose() * (transfer.apply(tie.from_mm) - tie.to_mm);
    const double chi = std::sqrt(away.cwiseAbs2().cwiseQuotient(own.values).sum());
    const double weight = chi > kSigmas ? kSigmas / chi : 1.0;
    sums.chi_squared += tie.share * (chi > kSigmas ? kSigmas * (2.0 * chi - kSigmas) : chi * chi);
    sums.freedom += 3.0 * tie.share;
    for (Eigen::Index i = 0; i < 3; ++i) {
      const Eigen::VectorXd row =
          row_of(transfer.jacobian(own.vectors.col(i), tie.from_mm), state, tie.from, tie.to);
      const double information = tie.share * weight / own.values[i];
      sums.gradient += information * away[i] * row;
      sums.hessian += information * row * row.transpose();
    }
  }
  return sums;
}

}  // namespace frangia
