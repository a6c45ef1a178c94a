#include "frangia/core/linear_algebra.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>

namespace frangia {

Eigen::MatrixXd product_of_matrices(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return a * b;
}

Eigen::VectorXd product_with_vector(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  return a * b;
}

Eigen::MatrixXd transposed_product_of_matrices(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return a.transpose() * b;
}

Eigen::VectorXd transposed_product_with_vector(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  return a.transpose() * b;
}

Eigen::MatrixXd product_transposed(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return a * b.transpose();
}

Eigen::MatrixXd congruence(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return a.transpose() * (b * a);
}

Eigen::MatrixXd scaled(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& factors) {
  return factors.asDiagonal() * matrix * factors.asDiagonal();
}

Eigen::VectorXd solve_symmetric(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right) {
  return matrix.ldlt().solve(right);
}

Eigen::MatrixXd solve_symmetric_columns(const Eigen::MatrixXd& matrix,
                                        const Eigen::MatrixXd& right) {
  return matrix.ldlt().solve(right);
}

Cholesky::Cholesky(const Eigen::MatrixXd& matrix) {
  const Eigen::LLT<Eigen::MatrixXd> factors(matrix);
  lower_ = factors.matrixL();
  is_positive_ = factors.info() == Eigen::Success;
}

Eigen::VectorXd Cholesky::solve(const Eigen::VectorXd& right) const {
  return lower_.transpose().triangularView<Eigen::Upper>().solve(
      lower_.triangularView<Eigen::Lower>().solve(right));
}

Eigen::MatrixXd Cholesky::solve_columns(const Eigen::MatrixXd& right) const {
  return lower_.transpose().triangularView<Eigen::Upper>().solve(
      lower_.triangularView<Eigen::Lower>().solve(right));
}

Eigen::MatrixXd Cholesky::inverse_lower() const {
  return lower_.triangularView<Eigen::Lower>().solve(
      Eigen::MatrixXd::Identity(lower_.rows(), lower_.cols()));
}

double Cholesky::log_determinant() const {
  return 2.0 * lower_.diagonal().array().log().sum();
}

Eigen::MatrixXd least_squares(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& right) {
  return matrix.colPivHouseholderQr().solve(right);
}

ColumnSpace column_space(const Eigen::MatrixXd& matrix, double threshold) {
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(matrix);
  qr.setThreshold(threshold);
  const Eigen::MatrixXd all = qr.householderQ();
  return {all.leftCols(qr.rank()), all.rightCols(matrix.rows() - qr.rank())};
}

Eigen::MatrixXd orthonormal_basis(const Eigen::MatrixXd& matrix) {
  const Eigen::MatrixXd all = Eigen::HouseholderQR<Eigen::MatrixXd>(matrix).householderQ();
  return all.leftCols(matrix.cols());
}

namespace {

template <int n>
SymmetricEigen<n> eigen_of(const Eigen::Matrix<double, n, n>& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, n, n>> solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace

SymmetricEigen<3> symmetric_eigen(const Eigen::Matrix3d& matrix) {
  return eigen_of<3>(matrix);
}

SymmetricEigen<Eigen::Dynamic> symmetric_eigen(const Eigen::MatrixXd& matrix) {
  return eigen_of<Eigen::Dynamic>(matrix);
}

}  // namespace frangia
