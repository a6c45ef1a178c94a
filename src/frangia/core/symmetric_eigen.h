#pragma once

#include <Eigen/Core>

namespace frangia {

/// Eigenvalues in ascending order. Column i of `vectors` is the eigenvector of `values(i)`.
template <int n>
struct SymmetricEigen {
  Eigen::Matrix<double, n, 1> values;   ///< ascending
  Eigen::Matrix<double, n, n> vectors;  ///< unit eigenvectors as columns
};

/// Computes the eigendecomposition of a symmetric matrix.
///
/// @shape    n x n; only the lower triangle is read
/// @source   tridiagonal QR of Eigen, compiled once because its templates compile slowly
[[nodiscard]] SymmetricEigen<3> symmetric_eigen(const Eigen::Matrix3d& matrix);
/// The same for a matrix of any size.
[[nodiscard]] SymmetricEigen<Eigen::Dynamic> symmetric_eigen(const Eigen::MatrixXd& matrix);

}  // namespace frangia
