#include "frangia/core/least_squares.h"

#include <Eigen/QR>

namespace frangia {

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

}  // namespace frangia
