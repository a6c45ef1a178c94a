#include "frangia/range/difference_uncertainty.h"

#include <cmath>
#include <memory>
#include <utility>

#include "frangia/range/internal/changed_rigs.h"

namespace frangia {
namespace {

/// A rig and the two ways in which it measures a point.
struct TwoWays {
  Rig rig;
  Pattern first_pattern;
  Pattern second_pattern;
  ChangedRigs first;
  ChangedRigs second;

  TwoWays(const Rig& measured,
          Pattern one,
          Pattern other,
          std::size_t first_camera,
          std::size_t second_camera)
      : rig(measured),
        first_pattern(std::move(one)),
        second_pattern(std::move(other)),
        first(rig, first_pattern, first_camera),
        second(rig, second_pattern, second_camera) {}
};

bool has_covariance(const Rig& rig) {
  return rig.calibration && !rig.calibration->covariance.empty();
}

/// Two points of the stated uncertainty; empty without one.
DifferenceUncertainty of_two_points(const Rig& rig) {
  if (!rig.calibration || !(rig.calibration->point_sigma_mm > 0.0)) return {};
  const double apart_mm = std::sqrt(2.0) * rig.calibration->point_sigma_mm;
  return [apart_mm](const Eigen::Vector3d& /*point_mm*/) { return apart_mm; };
}

}  // namespace

DifferenceUncertainty between_directions(const Rig& rig,
                                         const Pattern& first,
                                         const Pattern& second) {
  if (!has_covariance(rig)) return of_two_points(rig);
  const auto ways = std::make_shared<const TwoWays>(rig, first, second, 0, 0);
  return [ways](const Eigen::Vector3d& point_mm) {
    const Displacements apart =
        ways->first.displacements_of(point_mm) - ways->second.displacements_of(point_mm);
    return (point_mm.normalized().transpose() * apart).norm();
  };
}

DifferenceUncertainty between_cameras(const Rig& rig,
                                      const Pattern& pattern,
                                      std::size_t own,
                                      std::size_t other) {
  if (!has_covariance(rig)) return of_two_points(rig);
  const Eigen::Isometry3d rig_from_own = rig.cameras[own].camera_from_rig().inverse();
  if (rig.projector.is_label) {
    const auto rays = std::make_shared<const ChangedRays>(rig);
    return [rays, rig_from_own, own, other](const Eigen::Vector3d& point_mm) {
      return rays->distances_of(rig_from_own * point_mm, own, other).norm();
    };
  }
  const auto ways = std::make_shared<const TwoWays>(rig, pattern, pattern, own, other);
  return [ways, rig_from_own](const Eigen::Vector3d& point_mm) {
    const Eigen::Vector3d point = rig_from_own * point_mm;
    const Eigen::Vector3d ray = rig_from_own.linear() * point_mm.normalized();
    const Displacements apart =
        ways->first.displacements_of(point) - ways->second.displacements_of(point);
    return (ray.transpose() * apart).norm();
  };
}

}  // namespace frangia
