#include "frangia/core/cholesky.h"

#include <Eigen/Cholesky>

namespace frangia {

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

}  // namespace frangia
