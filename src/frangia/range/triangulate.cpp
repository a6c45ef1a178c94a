#include "frangia/range/triangulate.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/rig/rig.h"

namespace frangia {

RangeGrid triangulate(AbsolutePhase& phase, const Rig& rig, const Image<Eigen::Vector2f>& rays) {
  require(same_size(phase.phase_rad, rays), "triangulate: phase and rays differ in size");
  const int width = rays.width();
  RangeGrid out{Image<float>(width, rays.height(), Uninitialized{}),
                Image<float>(width, rays.height(), Uninitialized{}),
                Image<float>(width, rays.height(), Uninitialized{})};
  const bool has_systematic = !phase.systematic_rad.empty();
  if (has_systematic) out.systematic_mm = Image<float>(width, rays.height(), kMissing);
  out.differing_share = phase.differing_share;
  const PhaseRange lit = phase_range(phase.pattern, rig.projector);
  parallel_rows(rays.height(), [&](int y) {
    for (Image<float>* image : {&out.depth_mm, &out.sigma_mm, &out.phase_rad})
      std::fill_n(&(*image)(0, y), width, kMissing);
    for (int x = 0; x < width; ++x) {
      const float measured_rad = phase.phase_rad(x, y);
      const double phi = measured_rad;
      if (std::isnan(phi)) continue;
      const double sigma = phase.sigma_rad(x, y);
      const Eigen::Vector2d ray = rays(x, y).cast<double>();
      const bool in_field = phi > lit.min_rad - 4.0 * sigma && phi < lit.max_rad + 4.0 * sigma;
      const RayDepth found = in_field ? intersect_fringe(ray, phi, phase.pattern, rig.projector)
                                      : RayDepth{kMissing, kMissing};
      if (std::isnan(found.depth_mm)) {
        phase.status(x, y) = PixelStatus::OutOfField;
        continue;
      }
      const double along_ray = std::sqrt(1.0 + ray.squaredNorm());
      out.set({x,
               y,
               static_cast<float>(found.depth_mm),
               static_cast<float>(std::abs(found.mm_per_rad) * sigma * along_ray),
               measured_rad,
               has_systematic ? static_cast<float>(std::abs(found.mm_per_rad) *
                                                   phase.systematic_rad(x, y) * along_ray)
                              : kMissing});
    }
  });
  return out;
}

namespace {

constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();

/// Intersects the ray (x, y, 1) t with the plane normal . (X - center) = 0. `normal_derivative` is
/// d normal / d angle.
RayDepth intersect_plane(const Eigen::Vector3d& direction,
                         const Eigen::Vector3d& normal,
                         const Eigen::Vector3d& normal_derivative,
                         const Eigen::Vector3d& center) {
  const double across = normal.dot(direction);
  const double depth = normal.dot(center) / across;
  if (!(depth > 0.0) || std::isinf(depth)) return {kNowhere, kNowhere};
  return {depth, normal_derivative.dot(center - depth * direction) / across};
}

RayDepth intersect_angle(const Eigen::Vector3d& direction,
                         double psi_rad,
                         const Projector& projector) {
  // psi = atan2(p.x, p.z) is the plane p.x cos psi - p.z sin psi = 0.
  const Eigen::Vector3d x = projector.rotation.row(0);
  const Eigen::Vector3d z = projector.rotation.row(2);
  const double c = std::cos(psi_rad);
  const double s = std::sin(psi_rad);
  return intersect_plane(direction, c * x - s * z, -s * x - c * z, projector.position_mm);
}

/// Intersects the ray with a surface of constant `fringe_angle_rad`: the plane of even fringes
/// gives the start; Newton's method along the ray then solves for the wavefront.
RayDepth intersect_wavefront(const Eigen::Vector3d& direction,
                             double angle_rad,
                             const Projector& projector) {
  const auto& angular = std::get<AngularModel>(projector.model);
  RayDepth found = intersect_angle(direction, angular.pitch_scale * angle_rad, projector);
  found.mm_per_rad *= angular.pitch_scale;
  if (angular.wavefront.is_plane()) return found;
  const Eigen::Vector3d step = projector.rotation * direction;
  constexpr int kIterations = 12;
  for (int i = 0; i < kIterations; ++i) {
    const Eigen::Vector3d p = projector.from_rig(found.depth_mm * direction);
    if (!(p.z() > 0.0)) return {kNowhere, kNowhere};
    const double error = angular.fringe_angle_rad(p) - angle_rad;
    // The deviation is smooth: a difference over some ten thousandths of the depth is
    // its derivative.
    const double side = 1e-4 * found.depth_mm;
    const double rad_per_mm =
        (angular.fringe_angle_rad(p + side * step) - angular.fringe_angle_rad(p - side * step)) /
        (2.0 * side);
    found.mm_per_rad = 1.0 / rad_per_mm;
    if (std::abs(error) < 1e-12) return found;
    found.depth_mm -= error / rad_per_mm;
    if (!(found.depth_mm > 0.0)) return {kNowhere, kNowhere};
  }
  return {kNowhere, kNowhere};
}

/// Intersects the ray with a projector column (axis 0) or row (axis 1). The undistorted column is a
/// plane and gives the start; Newton's method along the ray then solves for the distorted one.
RayDepth intersect_pixel(const Eigen::Vector3d& direction,
                         double pixel,
                         int axis,
                         const Projector& projector) {
  const auto& pinhole = std::get<PinholeModel>(projector.model);
  const double focal = pinhole.focal_px(axis);
  const double normalized = (pixel - pinhole.principal_point_px(axis)) / focal;
  const Eigen::Vector3d across = projector.rotation.row(axis);
  const Eigen::Vector3d forward = projector.rotation.row(2);
  RayDepth found = intersect_plane(
      direction, across - normalized * forward, -forward / focal, projector.position_mm);
  const Eigen::Vector3d step = projector.rotation * direction;
  constexpr int kIterations = 12;
  for (int i = 0; i < kIterations; ++i) {
    const Eigen::Vector3d p = projector.from_rig(found.depth_mm * direction);
    if (!(p.z() > 0.0)) return {kNowhere, kNowhere};
    const Eigen::Vector2d point = p.head<2>() / p.z();
    const Eigen::Vector2d moves = (step.head<2>() - point * step.z()) / p.z();
    const double error =
        focal * pinhole.distort(point)(axis) + pinhole.principal_point_px(axis) - pixel;
    const double px_per_mm = focal * pinhole.distort_jacobian(point).row(axis).dot(moves);
    found.mm_per_rad = 1.0 / px_per_mm;
    if (std::abs(error) < 1e-9) return found;
    found.depth_mm -= error / px_per_mm;
    if (!(found.depth_mm > 0.0)) return {kNowhere, kNowhere};
  }
  return {kNowhere, kNowhere};
}

}  // namespace

RayDepth intersect_fringe(const Eigen::Vector2d& ray,
                          double phase_rad,
                          const Pattern& pattern,
                          const Projector& projector) {
  const double unit = phase_rad / (kTwoPi * pattern.fringes_per_unit());  // degrees, or pixels
  const double unit_per_rad = 1.0 / (kTwoPi * pattern.fringes_per_unit());
  const Eigen::Vector3d direction(ray.x(), ray.y(), 1.0);
  if (projector.is_angular()) {
    RayDepth found = intersect_wavefront(direction, rad_from_deg(unit), projector);
    found.mm_per_rad *= rad_from_deg(unit_per_rad);
    return found;
  }
  const int axis = pattern.direction == FringeDirection::Horizontal ? 1 : 0;
  RayDepth found = intersect_pixel(direction, unit, axis, projector);
  found.mm_per_rad *= unit_per_rad;
  return found;
}

double phase_at(const Eigen::Vector3d& point_mm,
                const Pattern& pattern,
                const Projector& projector) {
  const Eigen::Vector3d p = projector.from_rig(point_mm);
  const double rad_per_unit = kTwoPi * pattern.fringes_per_unit();
  if (!(p.z() > 0.0)) return kNowhere;
  if (const auto* angular = std::get_if<AngularModel>(&projector.model))
    return rad_per_unit * deg_from_rad(angular->fringe_angle_rad(p));
  const int axis = pattern.direction == FringeDirection::Horizontal ? 1 : 0;
  return rad_per_unit * std::get<PinholeModel>(projector.model).project(p)(axis);
}

}  // namespace frangia
