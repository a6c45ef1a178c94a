#pragma once

#include <Eigen/Core>

namespace frangia {

/// The factor L of a symmetric positive definite matrix A = L L^T.
///
/// @source   Cholesky decomposition of Eigen, compiled once because its templates compile slowly
class Cholesky {
 public:
  /// @shape    n x n; only the lower triangle is read
  explicit Cholesky(const Eigen::MatrixXd& matrix);

  /// Whether the matrix is positive definite as far as it can be computed.
  [[nodiscard]] bool is_positive() const { return is_positive_; }
  /// The x of A x = `right`.
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& right) const;
  /// The same for several right sides, the columns of a matrix.
  [[nodiscard]] Eigen::MatrixXd solve_columns(const Eigen::MatrixXd& right) const;
  /// L
  [[nodiscard]] const Eigen::MatrixXd& lower() const { return lower_; }
  /// L^-1, a lower triangle.
  [[nodiscard]] Eigen::MatrixXd inverse_lower() const;
  /// Natural logarithm of the determinant of A.
  [[nodiscard]] double log_determinant() const;

 private:
  Eigen::MatrixXd lower_;
  bool is_positive_ = false;
};

}  // namespace frangia
