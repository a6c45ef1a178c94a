#include "frangia/rig/rig.h"

#include <cmath>
#include <variant>

#include "frangia/core/angles.h"
#include "frangia/core/linear_algebra.h"

namespace frangia {

Eigen::Isometry3d PosedCamera::camera_from_rig() const {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = rotation;
  pose.translation() = -rotation * position_mm;
  return pose;
}

Eigen::Isometry3d Turntable::rig_from_object(double angle_rad) const {
  // x points from the origin to the reference camera, made perpendicular to the axis; y = z cross
  // x.
  const Eigen::Vector3d to_camera = reference_mm - point_mm;
  const Eigen::Vector3d x = (to_camera - axis * axis.dot(to_camera)).normalized();
  Eigen::Matrix3d basis;
  basis << x, axis.cross(x), axis;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = basis * Eigen::AngleAxisd(angle_rad, Eigen::Vector3d::UnitZ()).matrix();
  pose.translation() = point_mm;
  return pose;
}

Eigen::Isometry3d Rig::rig_from_object(double angle_rad) const {
  return turntable ? turntable->rig_from_object(angle_rad) : Eigen::Isometry3d::Identity();
}

Rig rig_of_camera(const Rig& rig, std::size_t camera) {
  Rig out = rig;
  const PosedCamera& posed = rig.cameras.at(camera);
  out.cameras = {PosedCamera{posed.camera}};
  if (camera == 0) return out;
  const Eigen::Isometry3d to_camera = posed.camera_from_rig();
  out.calibration.reset();
  out.projector.position_mm = to_camera * rig.projector.position_mm;
  out.projector.rotation = rig.projector.rotation * posed.rotation.transpose();
  if (out.laser_sheet) {
    out.laser_sheet->normal = posed.rotation * rig.laser_sheet->normal;
    out.laser_sheet->offset_mm =
        rig.laser_sheet->offset_mm - rig.laser_sheet->normal.dot(posed.position_mm);
  }
  if (out.turntable) {
    out.turntable->point_mm = to_camera * rig.turntable->point_mm;
    out.turntable->axis = posed.rotation * rig.turntable->axis;
    out.turntable->reference_mm = to_camera * rig.turntable->reference_mm;
  }
  return out;
}

namespace {

/// Unit vector through the middle of an image.
Eigen::Vector3d middle_ray(const CameraModel& model) {
  const Eigen::Vector2d middle(0.5 * (model.width_px - 1), 0.5 * (model.height_px - 1));
  return model.ray(middle).homogeneous().normalized();
}

}  // namespace

Eigen::Vector3d crossing_of_axes(const Rig& rig) {
  const auto* pinhole = std::get_if<PinholeModel>(&rig.projector.model);
  const Eigen::Vector3d forward =
      pinhole != nullptr ? middle_ray(*pinhole) : Eigen::Vector3d(Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d camera = middle_ray(rig.reference().model);
  const Eigen::Vector3d light = rig.projector.rotation.transpose() * forward;
  Eigen::Matrix<double, 3, 2> directions;
  directions << camera, -light;
  const Eigen::Vector2d distances = solve_symmetric(
      directions.transpose() * directions, directions.transpose() * rig.projector.position_mm);
  return 0.5 * (distances[0] * camera + rig.projector.position_mm + distances[1] * light);
}

PhaseRange phase_range(const Pattern& pattern, const Projector& projector) {
  if (const auto* angular = std::get_if<AngularModel>(&projector.model)) {
    const double rad_per_rad =
        kTwoPi * pattern.fringes_per_degree * deg_from_rad(1.0) / angular->pitch_scale;
    return {rad_per_rad * angular->field_min_rad, rad_per_rad * angular->field_max_rad};
  }
  const auto& pinhole = std::get<PinholeModel>(projector.model);
  const bool rows = pattern.direction == FringeDirection::Horizontal;
  const double size_px = rows ? pinhole.height_px : pinhole.width_px;
  const double rad_per_px = kTwoPi / pattern.period_px;
  return {-0.5 * rad_per_px, (size_px - 0.5) * rad_per_px};  // the centre of pixel k is at k
}

bool is_absolute(const Pattern& pattern, const Projector& projector) {
  return pattern.kind == PatternKind::Fringe &&
         phase_range(pattern, projector).width_rad() <= kTwoPi * (1.0 + 1e-9);
}

double fringe_parallax_px(const Rig& rig, FringeDirection direction) {
  const auto* pinhole = std::get_if<PinholeModel>(&rig.projector.model);
  const double baseline_mm = rig.projector.position_mm.norm();
  if (pinhole == nullptr || rig.projector.is_label || !(baseline_mm > 0.0)) return 0.0;
  constexpr double kFartherShare = 0.01;
  constexpr double kUsualDistance = 3.0;  // baselines, for axes that do not meet before the camera
  const CameraModel& camera = rig.reference().model;
  const Eigen::Vector3d ray =
      camera.ray({0.5 * (camera.width_px - 1), 0.5 * (camera.height_px - 1)}).homogeneous();
  double depth_mm = crossing_of_axes(rig).z();
  if (!(depth_mm > 0.0)) depth_mm = kUsualDistance * baseline_mm;
  const auto seen_at = [&](double depth) {
    return pinhole->project(rig.projector.from_rig(depth * ray));
  };
  const Eigen::Vector2d moved = seen_at((1.0 + kFartherShare) * depth_mm) - seen_at(depth_mm);
  return std::abs(direction == FringeDirection::Vertical ? moved.x() : moved.y());
}

FringeDirection measuring_direction(const Rig& rig) {
  const double vertical = fringe_parallax_px(rig, FringeDirection::Vertical);
  const double horizontal = fringe_parallax_px(rig, FringeDirection::Horizontal);
  return horizontal > vertical ? FringeDirection::Horizontal : FringeDirection::Vertical;
}

bool lacks_parallax(const Rig& rig, FringeDirection direction) {
  constexpr double kNextToNothing = 0.05;
  const bool vertical = direction == FringeDirection::Vertical;
  const FringeDirection other = vertical ? FringeDirection::Horizontal : FringeDirection::Vertical;
  return fringe_parallax_px(rig, direction) < kNextToNothing * fringe_parallax_px(rig, other);
}

}  // namespace frangia
