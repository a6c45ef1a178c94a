#include "frangia/calibrate/internal/rig_covariance.h"

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "frangia/core/symmetric_eigen.h"

namespace frangia {
namespace {

constexpr std::array kIntrinsicNames = {
    "focal_px", "focal_ratio", "principal_x_px", "principal_y_px", "k1", "k2", "p1", "p2", "k3"};
constexpr std::array kPoseNames = {
    "rotation_x_rad", "rotation_y_rad", "rotation_z_rad", "x_mm", "y_mm", "z_mm"};

std::vector<std::string> free_names(const RigFreedom& freedom) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < kIntrinsicNames.size(); ++i)
    if (freedom.camera.at(i)) names.push_back(std::string("camera.") + kIntrinsicNames.at(i));
  for (std::size_t i = 0; i < kIntrinsicNames.size(); ++i)
    if (freedom.projector.at(i)) names.push_back(std::string("projector.") + kIntrinsicNames.at(i));
  for (const char* name : kPoseNames)
    names.push_back(std::string("projector.") + name);
  return names;
}

}  // namespace

void add_covariance(std::span<const RigObservation> observations,
                    const RigFreedom& freedom,
                    const RigNoise& noise,
                    const RigParameters& parameters,
                    RigSolution& solution) {
  constexpr double kOpen = 1e-12;
  const Eigen::MatrixXd jacobian = linearize_rig(observations, freedom, noise, parameters).jacobian;
  const Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
  const Eigen::VectorXd scale =
      normal.diagonal().cwiseSqrt().unaryExpr([](double s) { return s > 0.0 ? 1.0 / s : 0.0; });
  const auto eigen =
      symmetric_eigen(Eigen::MatrixXd(scale.asDiagonal() * normal * scale.asDiagonal()));
  const double least = kOpen * eigen.values.tail<1>()[0];

  solution.parameters = free_names(freedom);
  const auto kept = static_cast<Eigen::Index>(solution.parameters.size());
  Eigen::VectorXd open = Eigen::VectorXd::Zero(normal.rows());
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(normal.rows(), normal.rows());
  for (Eigen::Index i = 0; i < eigen.values.size(); ++i) {
    const Eigen::VectorXd direction = eigen.vectors.col(i);
    if (eigen.values[i] > least) {
      inverse += direction * direction.transpose() / eigen.values[i];
    } else {
      open += direction.cwiseAbs2();
    }
  }
  const Eigen::MatrixXd scaled = scale.asDiagonal() * inverse * scale.asDiagonal();
  solution.covariance = scaled.topLeftCorner(kept, kept);
  constexpr double kMuch = 0.1;  // share of a parameter that lies in open directions
  for (Eigen::Index i = 0; i < kept; ++i) {
    if (open[i] < kMuch) continue;
    solution.undetermined.push_back(solution.parameters[static_cast<std::size_t>(i)]);
    solution.covariance(i, i) = std::numeric_limits<double>::infinity();
  }
}

}  // namespace frangia
