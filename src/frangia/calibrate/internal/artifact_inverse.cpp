#include "frangia/calibrate/internal/artifact_inverse.h"

#include <cmath>

#include "frangia/core/symmetric_eigen.h"

namespace frangia {

ArtifactInverse invert_artifacts(const ArtifactLinearization& linear) {
  constexpr double kOpen = 1e-13;
  constexpr double kMuch = 0.1;  // share of a parameter that lies in open directions
  const Eigen::VectorXd scale = linear.normal.diagonal().unaryExpr(
      [](double square) { return square > 0.0 ? 1.0 / std::sqrt(square) : 0.0; });
  const auto eigen =
      symmetric_eigen(Eigen::MatrixXd(scale.asDiagonal() * linear.normal * scale.asDiagonal()));
  const double least = kOpen * eigen.values.tail<1>()[0];
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(scale.size(), scale.size());
  Eigen::VectorXd open = Eigen::VectorXd::Zero(scale.size());
  for (Eigen::Index i = 0; i < eigen.values.size(); ++i) {
    const Eigen::VectorXd direction = eigen.vectors.col(i);
    if (eigen.values[i] > least) {
      inverse += direction * direction.transpose() / eigen.values[i];
    } else {
      open += direction.cwiseAbs2();
    }
  }
  ArtifactInverse out{linear.names, scale.asDiagonal() * inverse * scale.asDiagonal(), {}};
  for (Eigen::Index i = 0; i < open.size(); ++i)
    if (open[i] > kMuch) out.open.push_back(linear.names[static_cast<std::size_t>(i)]);
  return out;
}

}  // namespace frangia
