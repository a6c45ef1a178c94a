#pragma once

#include <Eigen/Core>

namespace frangia {

/// Solves `matrix` x = `right` in the sense of least squares.
///
/// @shape    matrix m x n with m >= n, right m x k; the result is n x k
/// @missing  unknowns that the equations do not determine are zero
/// @source   Householder QR of Eigen with column pivoting, compiled once because its templates
/// compile slowly
[[nodiscard]] Eigen::MatrixXd least_squares(const Eigen::MatrixXd& matrix,
                                            const Eigen::MatrixXd& right);

/// Orthonormal columns that span those of a matrix.
///
/// @shape    m x n with m >= n; the result is m x n
/// @source   Householder QR of Eigen
[[nodiscard]] Eigen::MatrixXd orthonormal_basis(const Eigen::MatrixXd& matrix);

}  // namespace frangia
