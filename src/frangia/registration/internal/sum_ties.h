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

/// Compares the two places of each tie. Ties beyond four standard deviations count by Huber's
/// weight, so that one that was matched wrongly pulls no harder than a sound one.
///
/// @source   Huber 1964
[[nodiscard]] TieSums sum_ties(std::span<const PointTie> ties, const TableState& state);

}  // namespace frangia
