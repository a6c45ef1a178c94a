#include "frangia/phase/internal/fringe_model.h"

#include <cmath>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "frangia/core/error.h"

namespace frangia {
namespace {

/// Least ratio of eigenvalues of the normal matrix. At 1e-6 the noise is amplified a thousandfold.
constexpr double kMinEigenvalueRatio = 1e-6;

}  // namespace

Eigen::Vector3d fringe_model_row(double shift_rad) {
  return {1.0, std::cos(shift_rad), -std::sin(shift_rad)};
}

Eigen::Matrix3d fringe_normal_matrix(const std::vector<double>& shifts_rad) {
  if (shifts_rad.size() < 3) {
    throw Error(
        ErrorKind::Input,
        fmt::format("a phase needs at least 3 shifts, but the pattern has {}", shifts_rad.size()));
  }
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  for (const double shift : shifts_rad)
    normal += fringe_model_row(shift) * fringe_model_row(shift).transpose();
  const Eigen::Vector3d eigenvalues =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>().computeDirect(normal).eigenvalues();
  if (!(eigenvalues(0) > kMinEigenvalueRatio * eigenvalues(2))) {
    throw Error(ErrorKind::Input,
                "shifts_deg does not determine a phase: at least three shifts must differ, modulo "
                "360 degrees");
  }
  return normal;
}

}  // namespace frangia
