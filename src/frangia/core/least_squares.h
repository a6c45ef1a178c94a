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

/// The space of a matrix's columns.
struct ColumnSpace {
  Eigen::MatrixXd span;  ///< orthonormal columns that span it
  Eigen::MatrixXd rest;  ///< those of what is orthogonal to it
};

/// Splits all vectors into those that the columns of a matrix span and the others.
///
/// @shape    m x n; together the result has m columns of m rows
/// @source   Householder QR of Eigen with column pivoting: pivots below `threshold` of the largest
///           span nothing
[[nodiscard]] ColumnSpace column_space(const Eigen::MatrixXd& matrix, double threshold);

/// Orthonormal columns that span those of a matrix, or more where it has not full rank.
///
/// @shape    m x n with m >= n; the result is m x n
/// @source   Householder QR of Eigen
[[nodiscard]] Eigen::MatrixXd orthonormal_basis(const Eigen::MatrixXd& matrix);

}  // namespace frangia
