#pragma once

#include <Eigen/Core>

namespace frangia {

// Products of matrices of any size by Eigen, compiled once because their templates compile slowly:
// a source that multiplies by itself compiles for some seconds more with each kind of operand.

/// `a` `b`.
///
/// @shape    m x k, k x n; the result is m x n
[[nodiscard]] Eigen::MatrixXd product_of_matrices(const Eigen::MatrixXd& a,
                                                  const Eigen::MatrixXd& b);
/// `a`^T `b`.
///
/// @shape    k x m, k x n; the result is m x n
[[nodiscard]] Eigen::MatrixXd transposed_product_of_matrices(const Eigen::MatrixXd& a,
                                                             const Eigen::MatrixXd& b);
/// `a` `b`.
///
/// @shape    m x k, k; the result has m elements
[[nodiscard]] Eigen::VectorXd product_with_vector(const Eigen::MatrixXd& a,
                                                  const Eigen::VectorXd& b);
/// `a`^T `b`.
///
/// @shape    k x m, k; the result has m elements
[[nodiscard]] Eigen::VectorXd transposed_product_with_vector(const Eigen::MatrixXd& a,
                                                             const Eigen::VectorXd& b);

/// `a` `b`: a vector if `b` is one.
///
/// @shape    m x k, k x n; the result is m x n
template <typename Right>
[[nodiscard]] auto product(const Eigen::MatrixXd& a, const Eigen::MatrixBase<Right>& b) {
  if constexpr (Right::ColsAtCompileTime == 1)
    return product_with_vector(a, b);
  else
    return product_of_matrices(a, b);
}

/// `a`^T `b`: a vector if `b` is one.
///
/// @shape    k x m, k x n; the result is m x n
template <typename Right>
[[nodiscard]] auto transposed_product(const Eigen::MatrixXd& a, const Eigen::MatrixBase<Right>& b) {
  if constexpr (Right::ColsAtCompileTime == 1)
    return transposed_product_with_vector(a, b);
  else
    return transposed_product_of_matrices(a, b);
}

/// `a` `b`^T.
///
/// @shape    m x k, n x k; the result is m x n
[[nodiscard]] Eigen::MatrixXd product_transposed(const Eigen::MatrixXd& a,
                                                 const Eigen::MatrixXd& b);

/// `a`^T `b` `a`: a symmetric `b` in other unknowns.
///
/// @shape    k x n, k x k; the result is n x n
[[nodiscard]] Eigen::MatrixXd congruence(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

/// Rows and columns of a square matrix times the factor of each.
///
/// @shape    n x n, n; the result is n x n
[[nodiscard]] Eigen::MatrixXd scaled(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& factors);

/// Solves `matrix` x = `right` for symmetric positive definite normal equations.
///
/// @shape    n x n; only the lower triangle is read
/// @source   pivoted Cholesky L D L^T of Eigen, compiled once because its templates compile slowly
[[nodiscard]] Eigen::VectorXd solve_symmetric(const Eigen::MatrixXd& matrix,
                                              const Eigen::VectorXd& right);
/// The same for several right sides, the columns of a matrix.
[[nodiscard]] Eigen::MatrixXd solve_symmetric_columns(const Eigen::MatrixXd& matrix,
                                                      const Eigen::MatrixXd& right);

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
