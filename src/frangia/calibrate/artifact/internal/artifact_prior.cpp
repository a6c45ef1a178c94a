#include "frangia/calibrate/artifact/internal/artifact_prior.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/symmetric_eigen.h"
#include "frangia/rig/rig_covariance.h"

namespace frangia {
namespace {

constexpr std::array kPriorNames = {
    "focal_px", "focal_ratio", "principal_x_px", "principal_y_px", "k1", "k2", "p1", "p2", "k3"};

/// Place of a parameter of a rig's covariance among the 25 of the prior.
std::optional<Eigen::Index> prior_column(const std::string& name) {
  static constexpr std::array kPoseAndPitch = {"projector.rotation_x_rad",
                                               "projector.rotation_y_rad",
                                               "projector.rotation_z_rad",
                                               "projector.x_mm",
                                               "projector.y_mm",
                                               "projector.z_mm",
                                               "projector.pitch_scale"};
  for (std::size_t i = 0; i < kPriorNames.size(); ++i) {
    if (name == fmt::format("camera.{}", kPriorNames.at(i))) return static_cast<Eigen::Index>(i);
    if (name == fmt::format("projector.{}", kPriorNames.at(i)))
      return static_cast<Eigen::Index>(i) + 9;
  }
  for (std::size_t i = 0; i < kPoseAndPitch.size(); ++i)
    if (name == kPoseAndPitch.at(i)) return static_cast<Eigen::Index>(i) + 18;
  return std::nullopt;
}

}  // namespace

void set_artifact_prior(const Rig& start, ArtifactProblem& problem) {
  if (!start.calibration || start.calibration->covariance.empty()) return;
  const RigCovariance& known = start.calibration->covariance;
  std::vector<Eigen::Index> rows;
  std::vector<Eigen::Index> columns;
  for (std::size_t i = 0; i < known.parameters.size(); ++i) {
    const auto column = prior_column(known.parameters[i]);
    const auto row = static_cast<Eigen::Index>(i);
    const bool camera = column && *column < 9;
    if (!column || !(known.covariance(row, row) > 0.0)) continue;
    if (start.projector.is_angular() && !camera) continue;
    rows.push_back(row);
    columns.push_back(*column);
  }
  if (rows.empty()) return;
  const Eigen::MatrixXd covariance = known.covariance(rows, rows);
  const Eigen::VectorXd scale = covariance.diagonal().cwiseSqrt().cwiseInverse();
  const auto eigen =
      symmetric_eigen(Eigen::MatrixXd(scale.asDiagonal() * covariance * scale.asDiagonal()));
  constexpr double kLeast = 1e-9;  // of a correlation matrix that is written with nine digits
  const Eigen::VectorXd root = eigen.values.cwiseMax(kLeast).cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd whiten = root.asDiagonal() * eigen.vectors.transpose() * scale.asDiagonal();
  problem.prior = Eigen::MatrixXd::Zero(whiten.rows(), 25);
  for (std::size_t i = 0; i < columns.size(); ++i)
    problem.prior.col(columns[i]) = whiten.col(static_cast<Eigen::Index>(i));
  const auto covers = [&](Eigen::Index first, Eigen::Index count) {
    for (Eigen::Index i = first; i < first + count; ++i)
      if (std::find(columns.begin(), columns.end(), i) == columns.end()) return false;
    return true;
  };
  problem.free_camera = covers(0, 9);
  problem.free_intrinsics = problem.free_camera && covers(9, 15);
  if (!problem.free_camera || (!start.projector.is_angular() && !problem.free_intrinsics)) {
    problem.prior.resize(0, 25);
    problem.free_camera = problem.free_intrinsics = false;
  }
}

}  // namespace frangia
