#pragma once

#include <optional>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "frangia/pattern/pixel_layout.h"
#include "frangia/rig/camera_model.h"
#include "frangia/rig/fringe_waveform.h"
#include "frangia/rig/response_curve.h"

namespace frangia {

/// An interferometric projector. Its fringes are evenly spaced in the angle psi = atan2(p.x, p.z).
struct AngularModel {
  double field_min_rad = 0.0;  ///< start of the illuminated range of psi
  double field_max_rad = 0.0;  ///< end of the illuminated range of psi
  /// Angle from one fringe to the next, over that which `Pattern::fringes_per_degree` states.
  double pitch_scale = 1.0;
};

/// A digital projector. Its fringes are evenly spaced in projector pixels.
using PinholeModel = CameraModel;

/// The calibrated projector of a rig: interferometer or digital projector, and its pose.
struct Projector {
  std::variant<AngularModel, PinholeModel> model;          ///< fringe geometry
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();   ///< in the rig frame
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< projector_from_rig

  PixelLayout pixels = PixelLayout::Square;  ///< of a digital projector's chip
  /// Its fringes only label the points that two cameras see: pose and lens are not known.
  bool is_label = false;

  /// Response that a look-up table corrects before patterns are shown; none: patterns are shown
  /// uncorrected.
  std::optional<ResponseCurve> response = std::nullopt;
  /// Waveforms of the fringes that were shown without the look-up table, one per measured period.
  std::vector<FringeWaveform> waveforms{};

  /// Whether it is an interferometer, not a digital projector.
  [[nodiscard]] bool is_angular() const { return std::holds_alternative<AngularModel>(model); }
  /// Transforms a point from the rig frame to the projector frame.
  [[nodiscard]] Eigen::Vector3d from_rig(const Eigen::Vector3d& point_mm) const {
    return rotation * (point_mm - position_mm);
  }
};

}  // namespace frangia
