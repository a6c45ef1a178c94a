#include "frangia/range/internal/changed_rigs.h"

#include <cmath>
#include <cstddef>

#include <Eigen/QR>

#include "frangia/core/parallel.h"
#include "frangia/range/fringe_ray.h"
#include "frangia/rig/rig_covariance.h"

namespace frangia {
namespace {

/// Step of the central differences, in standard deviations: small enough for a linear response,
/// large enough for the tolerance of the triangulation, 1e-9 px.
constexpr double kStep = 0.1;

}  // namespace

ChangedRigs::ChangedRigs(const Rig& rig, const Pattern& pattern) : rig_(rig), pattern_(pattern) {
  const RigCovariance& known = rig.calibration->covariance;
  const Eigen::MatrixXd factor = covariance_factor(known);
  for (Eigen::Index i = 0; i < factor.cols(); ++i) {
    for (const double side : {kStep, -kStep})
      changed_.push_back(change_parameters(rig, known.parameters, side * factor.col(i)));
  }
}

Displacements ChangedRigs::displacements_of(const Eigen::Vector3d& point_mm) const {
  const Eigen::Vector2d pixel = rig_.camera.model.project(point_mm);
  const double phase_rad = phase_at(point_mm, pattern_, rig_.projector);
  const auto seen_by = [&](const Rig& rig) -> Eigen::Vector3d {
    const Eigen::Vector2d ray = rig.camera.model.ray(pixel);
    return intersect_fringe(ray, phase_rad, pattern_, rig.projector).depth_mm * ray.homogeneous();
  };
  Displacements moved(3, changes());
  for (Eigen::Index i = 0; i < changes(); ++i) {
    const auto pair = static_cast<std::size_t>(2 * i);
    moved.col(i) = (seen_by(changed_[pair]) - seen_by(changed_[pair + 1])) / (2.0 * kStep);
  }
  return moved;
}

RigidMotions fit_rigid(std::span<const Eigen::Vector3d> points, const ChangedRigs& rigs) {
  RigidMotions fit;
  for (const Eigen::Vector3d& point : points)
    fit.center += point / static_cast<double>(points.size());
  double squares = 0.0;
  for (const Eigen::Vector3d& point : points)
    squares += (point - fit.center).squaredNorm();
  if (squares > 0.0) fit.size_mm = std::sqrt(squares / static_cast<double>(points.size()));
  std::vector<Displacements> moved(points.size());
  parallel_chunks(points.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      moved[i] = rigs.displacements_of(points[i]);
  });
  Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, Eigen::Dynamic> right(6, rigs.changes());
  right.setZero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!moved[i].allFinite()) continue;
    const auto rows = fit.design(points[i]);
    normal += rows.transpose() * rows;
    right += rows.transpose() * moved[i];
  }
  fit.motions = normal.completeOrthogonalDecomposition().solve(right);
  return fit;
}

}  // namespace frangia
