#include "frangia/core/least_squares.h"

#include <Eigen/QR>

namespace frangia {

Eigen::MatrixXd least_squares(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& right) {
  return matrix.colPivHouseholderQr().solve(right);
}

Eigen::MatrixXd orthonormal_basis(const Eigen::MatrixXd& matrix) {
  const Eigen::MatrixXd all = Eigen::HouseholderQR<Eigen::MatrixXd>(matrix).householderQ();
  return all.leftCols(matrix.cols());
}

}  // namespace frangia
