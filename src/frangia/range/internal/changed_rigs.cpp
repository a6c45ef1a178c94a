#include "frangia/range/internal/changed_rigs.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <Eigen/QR>

#include "frangia/core/parallel.h"
#include "frangia/range/triangulate.h"
#include "frangia/rig/rig.h"
#include "frangia/rig/rig_covariance.h"

namespace frangia {
namespace {

/// Step of the central differences, in standard deviations: small enough for a linear response,
/// large enough for the tolerance of the triangulation, 1e-9 px.
constexpr double kDifferenceStep = 0.1;

/// A camera's ray in the rig frame.
struct RigRay {
  Eigen::Vector3d origin;
  Eigen::Vector3d direction;
};

Eigen::Vector2d pixel_of(const Rig& rig, std::size_t camera, const Eigen::Vector3d& point_mm) {
  return rig.cameras[camera].camera.model.project(rig.cameras[camera].camera_from_rig() * point_mm);
}

RigRay ray_of(const Rig& rig, std::size_t camera, const Eigen::Vector2d& pixel) {
  const Eigen::Isometry3d rig_from_camera = rig.cameras[camera].camera_from_rig().inverse();
  return {rig_from_camera.translation(),
          rig_from_camera.linear() * rig.cameras[camera].camera.model.ray(pixel).homogeneous()};
}

/// The point on a camera's ray that the partner sees nearest to its pixel.
Eigen::Vector3d seen_nearest(const RigRay& ray,
                             const Rig& rig,
                             std::size_t partner,
                             const Eigen::Vector2d& pixel,
                             double start) {
  constexpr int kIterations = 4;  // Gauss-Newton on one unknown, from within a percent
  constexpr double kShare = 1e-4;
  double along = start;
  const auto project = [&](double at) {
    return pixel_of(rig, partner, ray.origin + at * ray.direction);
  };
  for (int i = 0; i < kIterations; ++i) {
    const double step = kShare * along;
    const Eigen::Vector2d moves = (project(along + step) - project(along - step)) / (2.0 * step);
    along += moves.dot(pixel - project(along)) / moves.squaredNorm();
  }
  return ray.origin + along * ray.direction;
}

/// Normal equations of a motion for each change.
struct MotionSums {
  Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, Eigen::Dynamic> right;
  double rows = 0.0;

  explicit MotionSums(Eigen::Index changes) : right(6, changes) { right.setZero(); }

  /// Leaves out what a changed rig does not measure.
  void add(const Eigen::Matrix<double, Eigen::Dynamic, 6, 0, 3, 6>& design,
           const Eigen::MatrixXd& moved) {
    if (!moved.allFinite()) return;
    normal += design.transpose() * design;
    right += design.transpose() * moved;
    rows += 1.0;
  }
};

/// How far two views contradict each other at shared places, along the normal.
MotionSums sum_agreement(const RigidMotions& motions,
                         const std::vector<SharedPlace>& shared,
                         const ChangedRigs& rigs) {
  std::vector<Eigen::RowVectorXd> apart(shared.size());
  parallel_chunks(shared.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const SharedPlace& place = shared[i];
      apart[i] = place.first_normal.transpose() * rigs.displacements_of(place.first_mm) -
                 place.second_normal.transpose() * rigs.displacements_of(place.second_mm);
    }
  });
  MotionSums sums(rigs.changes());
  for (std::size_t i = 0; i < shared.size(); ++i) {
    const SharedPlace& place = shared[i];
    sums.add(place.first_normal.transpose() * motions.design(place.first_mm) -
                 place.second_normal.transpose() * motions.design(place.second_mm),
             apart[i]);
  }
  return sums;
}

/// In pairs: by a step of each independent change in either direction.
std::vector<Rig> changed_rigs_of(const Rig& rig) {
  const RigCovariance& known = rig.calibration->covariance;
  const Eigen::MatrixXd factor = covariance_factor(known);
  std::vector<Rig> changed;
  for (Eigen::Index i = 0; i < factor.cols(); ++i) {
    for (const double side : {kDifferenceStep, -kDifferenceStep})
      changed.push_back(change_parameters(rig, known.parameters, side * factor.col(i)));
  }
  return changed;
}

}  // namespace

ChangedRigs::ChangedRigs(const Rig& rig, const Pattern& pattern, std::size_t camera)
    : rig_(rig), pattern_(pattern), camera_(camera), changed_(changed_rigs_of(rig)) {}

ChangedRays::ChangedRays(const Rig& rig) : rig_(rig), changed_(changed_rigs_of(rig)) {}

Eigen::VectorXd ChangedRays::distances_of(const Eigen::Vector3d& point_mm,
                                          std::size_t first,
                                          std::size_t second) const {
  const Eigen::Vector2d first_px = pixel_of(rig_, first, point_mm);
  const Eigen::Vector2d second_px = pixel_of(rig_, second, point_mm);
  const auto distance = [&](const Rig& rig) {
    const RigRay one = ray_of(rig, first, first_px);
    const RigRay other = ray_of(rig, second, second_px);
    return one.direction.cross(other.direction).normalized().dot(other.origin - one.origin);
  };
  Eigen::VectorXd out(static_cast<Eigen::Index>(changed_.size() / 2));
  for (Eigen::Index i = 0; i < out.size(); ++i) {
    const auto pair = static_cast<std::size_t>(2 * i);
    out[i] = (distance(changed_[pair]) - distance(changed_[pair + 1])) / (2.0 * kDifferenceStep);
  }
  return out;
}

Displacements ChangedRigs::displacements_of(const Eigen::Vector3d& point_mm) const {
  const bool is_label = rig_.projector.is_label;
  const Eigen::Vector2d pixel = pixel_of(rig_, camera_, point_mm);
  const std::size_t partner = camera_ == 0 ? 1 : 0;
  Eigen::Vector2d partner_pixel = Eigen::Vector2d::Zero();
  double phase_rad = 0.0;
  if (is_label) {
    partner_pixel = pixel_of(rig_, partner, point_mm);
  } else {
    phase_rad = phase_at(point_mm, pattern_, rig_.projector);
  }
  const double depth = (rig_.cameras[camera_].camera_from_rig() * point_mm).z();
  const auto seen_by = [&](const Rig& rig) -> Eigen::Vector3d {
    if (is_label)
      return seen_nearest(ray_of(rig, camera_, pixel), rig, partner, partner_pixel, depth);
    const Eigen::Vector2d ray = rig.cameras[camera_].camera.model.ray(pixel);
    if (camera_ == 0)
      return intersect_fringe(ray, phase_rad, pattern_, rig.projector).depth_mm * ray.homogeneous();
    const Rig of_camera = rig_of_camera(rig, camera_);
    const double lit = intersect_fringe(ray, phase_rad, pattern_, of_camera.projector).depth_mm;
    return rig.cameras[camera_].camera_from_rig().inverse() *
           Eigen::Vector3d(lit * ray.homogeneous());
  };
  Displacements moved(3, changes());
  for (Eigen::Index i = 0; i < changes(); ++i) {
    const auto pair = static_cast<std::size_t>(2 * i);
    moved.col(i) =
        (seen_by(changed_[pair]) - seen_by(changed_[pair + 1])) / (2.0 * kDifferenceStep);
  }
  return moved;
}

RigidMotions fit_rigid(const MeasuredVolume& volume, const ChangedRigs& rigs) {
  const std::vector<Eigen::Vector3d>& points = volume.points_mm;
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
  MotionSums sums(rigs.changes());
  for (std::size_t i = 0; i < points.size(); ++i)
    sums.add(fit.design(points[i]), moved[i]);
  const MotionSums agreement = sum_agreement(fit, volume.shared, rigs);
  // Views that are turned by 45 degrees determine the motion across the axis a hundred times as
  // well.
  constexpr double kShareOfFit = 1e-3;
  Eigen::Matrix<double, 6, 6> normal = sums.normal;
  Eigen::Matrix<double, 6, Eigen::Dynamic> right = sums.right;
  if (agreement.rows > 0) {
    const double weight = kShareOfFit * agreement.rows / std::max(1.0, sums.rows);
    normal = agreement.normal + weight * sums.normal;
    right = agreement.right + weight * sums.right;
  }
  fit.motions = normal.completeOrthogonalDecomposition().solve(right);
  return fit;
}

}  // namespace frangia
