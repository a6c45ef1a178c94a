#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "frangia/core/missing.h"
#include "frangia/frames/noise_model.h"
#include "frangia/pattern/pattern.h"
#include "frangia/rig/calibration.h"
#include "frangia/rig/camera_model.h"
#include "frangia/rig/projector.h"

namespace frangia {

/// A calibrated camera of a rig.
struct Camera {
  CameraModel model;                ///< projection and distortion
  int white_level = 255;            ///< a pixel at or above this level is saturated
  std::optional<NoiseModel> noise;  ///< estimated from the frames if absent
  std::string name{};               ///< folder of its frames; empty for the reference camera
};

/// A camera of a rig and its pose.
struct PosedCamera {
  Camera camera;                                           ///< projection, noise and name
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();   ///< in the rig frame
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< camera_from_rig

  /// Transforms from the rig frame to the camera's frame.
  [[nodiscard]] Eigen::Isometry3d camera_from_rig() const;
};

/// The laser sheet: the plane normal . X = offset_mm in the rig frame.
struct LaserSheet {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();  ///< unit
  double offset_mm = 0.0;  ///< signed distance of the plane from the camera's center
};

/// The axis of rotation in the rig frame.
struct Turntable {
  Eigen::Vector3d point_mm = Eigen::Vector3d::Zero();  ///< point on the axis of rotation
  Eigen::Vector3d axis =
      -Eigen::Vector3d::UnitY();  ///< unit vector that points up from the turntable top
  /// Point towards which the object's x axis points: the centre of the reference camera.
  Eigen::Vector3d reference_mm = Eigen::Vector3d::Zero();
  /// Standard deviations of what the rig states: of the axis' place at `point_mm` in each of the
  /// two directions across it, of its direction in each of two, and of the angle of a view. NaN:
  /// not stated.
  double point_sigma_mm = kMissing;
  double axis_sigma_rad = kMissing;   ///< of the direction, as above
  double angle_sigma_rad = kMissing;  ///< of an angle, as above

  /// Returns the pose of the object at table angle `angle_rad`: point + [x y z] Rz(angle) p.
  [[nodiscard]] Eigen::Isometry3d rig_from_object(double angle_rad) const;
};

/// The calibrated scanner. The rig frame is that of the reference camera: x right, y down, z
/// forward, in mm.
struct Rig {
  /// The reference camera first, at the identity: its frame is that of the rig. The others have
  /// distinct names.
  std::vector<PosedCamera> cameras = std::vector<PosedCamera>(1);
  Projector projector;                    ///< interferometer or digital projector
  std::optional<LaserSheet> laser_sheet;  ///< gives fringe orders; none: the rig has no such source
  std::optional<Turntable> turntable;     ///< none: the object stays where it is
  std::optional<Calibration> calibration = std::nullopt;  ///< none: its origin is not known

  [[nodiscard]] const Camera& reference() const { return cameras.front().camera; }  ///< camera 0
  [[nodiscard]] Camera& reference() { return cameras.front().camera; }              ///< camera 0
  /// Returns `Turntable::rig_from_object`, or the identity for a rig without a turntable.
  [[nodiscard]] Eigen::Isometry3d rig_from_object(double angle_rad) const;
};

/// Returns the rig as a rig with one camera: its frame is that of the given camera. What works with
/// the reference camera works with every other one in its own frame. The object frame stays that of
/// the reference camera.
///
/// @missing  the covariance of the calibration is that of the reference camera, and is left out for
///           the others
[[nodiscard]] Rig rig_of_camera(const Rig& rig, std::size_t camera);

/// Returns whether points can be triangulated: the poses and lenses of camera and projector are
/// known. Without them, phases can still be decoded.
[[nodiscard]] inline bool has_geometry(const Rig& rig) {
  const auto knows_lens = [](const CameraModel& model) {
    return model.focal_px.allFinite() && model.principal_point_px.allFinite() &&
           model.focal_px.minCoeff() > 0.0;
  };
  const auto* pinhole = std::get_if<PinholeModel>(&rig.projector.model);
  return knows_lens(rig.reference().model) && rig.projector.position_mm.allFinite() &&
         rig.projector.rotation.allFinite() && (pinhole == nullptr || knows_lens(*pinhole));
}

/// The point in the middle between the axes of camera and projector where they are nearest.
///
/// @units    mm, rig frame
[[nodiscard]] Eigen::Vector3d crossing_of_axes(const Rig& rig);

/// The range of absolute phases over the illuminated field.
struct PhaseRange {
  double min_rad = 0.0;  ///< smallest phase in the field
  double max_rad = 0.0;  ///< largest phase in the field
  /// Difference of the largest and the smallest phase.
  [[nodiscard]] double width_rad() const { return max_rad - min_rad; }
  /// Phase in the middle of the range.
  [[nodiscard]] double center_rad() const { return 0.5 * (min_rad + max_rad); }
};

/// Returns the range of a pattern's absolute phase over the projector's field.
[[nodiscard]] PhaseRange phase_range(const Pattern& pattern, const Projector& projector);

/// Returns whether the field spans at most one fringe, so that the wrapped phase is the absolute
/// phase.
[[nodiscard]] bool is_absolute(const Pattern& pattern, const Projector& projector);

/// How far a point moves across fringes of a direction, in pixels of the projector, when its depth
/// in the middle of the camera's image grows by 1 %, where the axes of camera and projector come
/// nearest. Fringes without parallax do not measure depth.
///
/// @units    px
/// @missing  0 for an angular projector, a label, and a projector at the place of the camera
[[nodiscard]] double fringe_parallax_px(const Rig& rig, FringeDirection direction);

/// The direction of fringes that measures depth better: horizontal for a projector above or below
/// the camera, vertical for one to its left or right and for an angular projector.
[[nodiscard]] FringeDirection measuring_direction(const Rig& rig);

/// Whether fringes of a direction measure next to nothing, while those of the other would: their
/// parallax is less than a twentieth.
[[nodiscard]] bool lacks_parallax(const Rig& rig, FringeDirection direction);

}  // namespace frangia
