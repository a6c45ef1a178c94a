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

}  // namespace frangia
