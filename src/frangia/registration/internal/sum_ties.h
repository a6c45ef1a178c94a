#pragma once

#include <cstddef>
#include <span>

#include <Eigen/Core>

#include "frangia/registration/internal/table_state.h"
#include "frangia/registration/point_tie.h"

namespace frangia {

/// Normal equations of points that two views measured, in one state. They are added to those of the
/// pairs of surfels.
///
/// @shape    unknowns: as `TableState` orders them
/// @units    rad, mm
struct TieSums {
  Eigen::MatrixXd hessian;
  Eigen::VectorXd gradient;
  double chi_squared = 0.0;  ///< by Huber's loss
  double freedom = 0.0;      ///< coordinates that are compared

  /// Their scatter over what their sigma says, at least 1.
  [[nodiscard]] double excess() const;
};

/// The two places of a tie along the axes of their covariance, which are independent.
struct TieResidual {
  Eigen::Matrix3d axes;         ///< unit vectors as columns
  Eigen::Vector3d away_mm;      ///< along them
  Eigen::Vector3d information;  ///< of each, per mm^2, with the share of the tie and Huber's weight
  double chi = 0.0;             ///< distance over its standard deviation

  /// Ties beyond this many standard deviations count by Huber's weight.
  static constexpr double kSigmas = 4.0;
};

/// @shape    `away_mm`, `covariance_mm2`: of the place of `from` from that of `to`, in one frame
/// @source   Huber 1964
[[nodiscard]] TieResidual tie_residual(const Eigen::Vector3d& away_mm,
                                       const Eigen::Matrix3d& covariance_mm2,
                                       double share);

/// Compares the two places of each tie. Ties beyond four standard deviations count by Huber's
/// weight, so that one that was matched wrongly pulls no harder than a sound one.
///
/// @source   Huber 1964
[[nodiscard]] TieSums sum_ties(std::span<const PointTie> ties, const TableState& state);

}  // namespace frangia
