#pragma once

#include <optional>

#include <Eigen/Geometry>

#include "frangia/frames/noise_model.h"
#include "frangia/rig/camera_model.h"
#include "frangia/rig/projector.h"

namespace frangia {

struct Camera {
  CameraModel model;
  int white_level = 255;            ///< the value at which a pixel is saturated
  std::optional<NoiseModel> noise;  ///< estimated from the frames where it is not given
};

/// The single plane of light: normal . X = offset_mm, in the rig frame.
struct LaserSheet {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();  ///< unit
  double offset_mm = 0.0;
};

/// The axis of rotation, in the rig frame.
struct Turntable {
  Eigen::Vector3d point_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis = -Eigen::Vector3d::UnitY();  ///< unit, up, away from the platter

  /// Where an object point is seen at table angle `angle_rad`: point + [x y z] Rz(a) p.
  [[nodiscard]] Eigen::Isometry3d rig_from_object(double angle_rad) const;
};

/// Everything the light meets. Rig frame = camera frame: x right, y down, z forward; mm.
struct Rig {
  Camera camera;
  Projector projector;
  std::optional<LaserSheet> laser_sheet;
  std::optional<Turntable> turntable;

  /// `Turntable::rig_from_object`, or the identity for a rig without a turntable.
  [[nodiscard]] Eigen::Isometry3d rig_from_object(double angle_rad) const;
};

}  // namespace frangia
