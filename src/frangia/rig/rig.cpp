#include "frangia/rig/rig.h"

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

}  // namespace frangia
