#include "frangia/calibrate/internal/invert_normal.h"

#include <cmath>

#include "frangia/core/symmetric_eigen.h"

namespace frangia {

NormalInverse invert_normal(const Eigen::MatrixXd& normal, double least) {
  const Eigen::VectorXd scale = normal.diagonal().unaryExpr(
      [](double square) { return square > 0.0 ? 1.0 / std::sqrt(square) : 0.0; });
  const auto eigen =
      symmetric_eigen(Eigen::MatrixXd(scale.asDiagonal() * normal * scale.asDiagonal()));
  const double threshold = least * eigen.values.tail<1>()[0];
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(scale.size(), scale.size());
  Eigen::VectorXd open = Eigen::VectorXd::Zero(scale.size());
  for (Eigen::Index i = 0; i < eigen.values.size(); ++i) {
    const Eigen::VectorXd direction = eigen.vectors.col(i);
    if (eigen.values[i] > threshold) {
      inverse += direction * direction.transpose() / eigen.values[i];
    } else {
      open += direction.cwiseAbs2();
    }
  }
  return {scale.asDiagonal() * inverse * scale.asDiagonal(), open};
}

}  // namespace frangia
