#pragma once

#include <Eigen/Core>

#include "frangia/registration/explain/internal/pose_sums.h"

namespace frangia {

/// What a hypothesis finds: the most probable motions of the views, and their uncertainty.
///
/// @shape    `motion`: the unknowns of `PoseSums`; `factor`: unknowns x independent changes of one
///           standard deviation; `table`, `changes`: a and b of the hypothesis
struct PosePosterior {
  Eigen::VectorXd motion;
  Eigen::MatrixXd factor;
  Eigen::VectorXd table;
  Eigen::VectorXd changes;
  Eigen::MatrixXd changes_covariance;
};

/// Evidence of linear hypotheses about the motions x of views from where they are stated.
///
/// Each hypothesis is x = T a + U b, a and b having independent elements of unit variance: T, the
/// table's axis and angles, is in all of them; U is the hypothesis' own. The probability of the
/// data is integrated over a and b, which is the price of a parameter.
/// @source   MacKay 1992, Bayesian interpolation
class PoseEvidence {
 public:
  /// @shape    `data`: in x, at x = 0; `table`: T
  PoseEvidence(NormalEquations data, Eigen::MatrixXd table);

  /// Logarithm of the odds of the table against one that is exact.
  [[nodiscard]] double table_log_odds() const;
  /// The data after the table has been fitted to it, in x.
  [[nodiscard]] const NormalEquations& without_table() const { return reduced_; }
  /// Logarithm of the odds against the table alone.
  ///
  /// @shape    `hessian`: U^T H U, `gradient`: U^T g, of `without_table`
  [[nodiscard]] static double log_odds(const Eigen::MatrixXd& hessian,
                                       const Eigen::VectorXd& gradient);
  [[nodiscard]] PosePosterior posterior(const Eigen::MatrixXd& own) const;
  /// x^T H x / 2 + g^T x.
  [[nodiscard]] double loss(const Eigen::VectorXd& motion) const;
  [[nodiscard]] const NormalEquations& data() const { return data_; }

 private:
  NormalEquations data_;
  Eigen::MatrixXd table_;
  NormalEquations reduced_;
};

}  // namespace frangia
