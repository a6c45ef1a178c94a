#pragma once

#include <Eigen/Core>

namespace frangia {

/// Solves `matrix` x = `right` for symmetric positive definite normal equations.
///
/// @shape    n x n; only the lower triangle is read
/// @source   pivoted Cholesky L D L^T of Eigen, compiled once because its templates compile slowly
[[nodiscard]] Eigen::VectorXd solve_symmetric(const Eigen::MatrixXd& matrix,
                                              const Eigen::VectorXd& right);
/// The same for several right sides, the columns of a matrix.
[[nodiscard]] Eigen::MatrixXd solve_symmetric_columns(const Eigen::MatrixXd& matrix,
                                                      const Eigen::MatrixXd& right);

}  // namespace frangia
