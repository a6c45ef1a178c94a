#pragma once

#include <Eigen/Core>

namespace frangia {

/// Eigenvalues, rising, and the eigenvector of each in the column of its number.
template <int n>
struct SymmetricEigen {
  Eigen::Matrix<double, n, 1> values;
  Eigen::Matrix<double, n, n> vectors;
};

/// Of a symmetric matrix, whose lower triangle alone is read.
///
/// source   tridiagonal QR, by Eigen; compiled once, for it takes long
[[nodiscard]] SymmetricEigen<3> symmetric_eigen(const Eigen::Matrix3d& matrix);
[[nodiscard]] SymmetricEigen<Eigen::Dynamic> symmetric_eigen(const Eigen::MatrixXd& matrix);

}  // namespace frangia
