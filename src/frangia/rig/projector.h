#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "frangia/pattern/pattern_picture.h"
#include "frangia/rig/camera_model.h"
#include "frangia/rig/fringe_waveform.h"
#include "frangia/rig/wavefront.h"

namespace frangia {

/// An interferometric projector. Its fringes are evenly spaced in the angle psi = atan2(p.x, p.z),
/// but for the deviation of its wavefront.
struct AngularModel {
  double field_min_rad = 0.0;  ///< start of the illuminated range of psi
  double field_max_rad = 0.0;  ///< end of the illuminated range of psi
  /// Angle from one fringe to the next, over that which `Pattern::fringes_per_degree` states.
  double pitch_scale = 1.0;
  Wavefront wavefront{};  ///< deviation from even fringes

  /// Coordinates of a direction in the field, see `Wavefront`.
  template <typename T>
  [[nodiscard]] std::array<T, 2> in_field(const T& x, const T& y, const T& z) const {
    using std::atan2;
    using std::sqrt;
    const double half = 0.5 * (field_max_rad - field_min_rad);
    const double middle = 0.5 * (field_max_rad + field_min_rad);
    return {T((atan2(x, z) - middle) / half), T(y / (sqrt(x * x + z * z) * half))};
  }
  /// The angle that counts the fringes at a point of the projector frame: psi with the deviation of
  /// the wavefront, over the scale of the pitch.
  [[nodiscard]] double fringe_angle_rad(const Eigen::Vector3d& p) const {
    const double psi = std::atan2(p.x(), p.z());
    if (wavefront.is_plane()) return psi / pitch_scale;
    const auto [u, v] = in_field(p.x(), p.y(), p.z());
    return (psi + Wavefront::deviation(wavefront.coefficients_rad.data(), u, v)) / pitch_scale;
  }
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
