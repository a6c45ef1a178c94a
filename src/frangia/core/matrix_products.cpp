#include "frangia/core/matrix_products.h"

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

}  // namespace frangia
