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

TieResidual tie_residual(const Eigen::Vector3d& away_mm,
                         const Eigen::Matrix3d& covariance_mm2,
                         double share) {
  const SymmetricEigen<3> own = symmetric_eigen(covariance_mm2);
  TieResidual out{own.vectors, own.vectors.transpose() * away_mm, {}};
  out.chi = std::sqrt(out.away_mm.cwiseAbs2().cwiseQuotient(own.values).sum());
  const double weight = share * TieResidual::kSigmas / std::max(out.chi, TieResidual::kSigmas);
  out.information = weight * own.values.cwiseInverse();
  return out;
}

TieSums sum_ties(std::span<const PointTie> ties, const TableState& state) {
  constexpr double kSigmas = TieResidual::kSigmas;
  TieSums sums{Eigen::MatrixXd::Zero(state.unknowns(), state.unknowns()),
               Eigen::VectorXd::Zero(state.unknowns())};
  for (const PointTie& tie : ties) {
    const ViewTransfer transfer(state, tie.from, tie.to);
    const Eigen::Matrix3d covariance =
        transfer.rotation() * tie.from_covariance_mm2 * transfer.rotation().transpose() +
        tie.to_covariance_mm2;
    const TieResidual tied =
        tie_residual(transfer.apply(tie.from_mm) - tie.to_mm, covariance, tie.share);
    const double chi = tied.chi;
    sums.chi_squared += tie.share * (chi > kSigmas ? kSigmas * (2.0 * chi - kSigmas) : chi * chi);
    sums.freedom += 3.0 * tie.share;
    for (Eigen::Index i = 0; i < 3; ++i) {
      const Eigen::VectorXd row =
          row_of(transfer.jacobian(tied.axes.col(i), tie.from_mm), state, tie.from, tie.to);
      sums.gradient += tied.information[i] * tied.away_mm[i] * row;
      sums.hessian += tied.information[i] * row * row.transpose();
    }
  }
  return sums;
}

}  // namespace frangia
