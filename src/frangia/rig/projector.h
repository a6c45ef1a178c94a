#pragma once

#include <optional>
#include <variant>

#include <Eigen/Core>

#include "frangia/rig/camera_model.h"
#include "frangia/rig/response_curve.h"

namespace frangia {

/// Interference fringes, evenly spaced in the angle psi = atan2(p.x, p.z).
struct AngularModel {
  double field_min_rad = 0.0;  ///< the lit range of psi
  double field_max_rad = 0.0;
};

/// A digital projector, evenly spaced in its own pixels.
using PinholeModel = CameraModel;

struct Projector {
  std::variant<AngularModel, PinholeModel> model;
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();   ///< in the rig frame
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< projector_from_rig

  /// What patterns are corrected for before they are shown; none is shown as it is.
  std::optional<ResponseCurve> response = std::nullopt;

  [[nodiscard]] bool is_angular() const { return std::holds_alternative<AngularModel>(model); }
  /// A point of the rig frame in the projector's own.
  [[nodiscard]] Eigen::Vector3d from_rig(const Eigen::Vector3d& point_mm) const {
    return rotation * (point_mm - position_mm);
  }
};

}  // namespace frangia
