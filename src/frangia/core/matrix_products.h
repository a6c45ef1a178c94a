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

}  // namespace frangia
