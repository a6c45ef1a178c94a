#pragma once

#include <Eigen/Geometry>

#include "frangia/core/image.h"
#include "frangia/range/camera_phases.h"
#include "frangia/range/internal/phase_sample.h"

namespace frangia {

/// The epipolar planes of two cameras. A direction has the angle of its plane about the baseline
/// and its cotangent to the baseline. A point at the distance r from the baseline has cotangents
/// in both cameras that differ by `baseline_mm` / r.
///
/// Unlike rectification to a common image plane, this holds for cameras in any position, one above
/// or behind the other too.
struct EpipolarPlanes {
  /// In the frame of the first camera: along the baseline to the second camera; towards the field;
  /// and perpendicular to both.
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< rows: along, forward, across
  double baseline_mm = 0.0;                            ///< distance of the centres

  /// Plane angle, rad, and cotangent of a direction in the frame of the first camera.
  [[nodiscard]] Eigen::Vector2d coordinates_of(const Eigen::Vector3d& direction) const;
};

/// Returns the epipolar planes of two cameras.
///
/// @errors   Error(Input) when both have the same centre
[[nodiscard]] EpipolarPlanes epipolar_planes(const Eigen::Isometry3d& second_from_first);

/// The phase of one camera on the epipolar planes: a row for each plane, a column for each
/// cotangent.
struct EpipolarRows {
  Image<float> phase_rad;    ///< NaN: not measured
  double first_angle = 0.0;  ///< of row 0, rad
  double first_cot = 0.0;    ///< of column 0
  double step = 0.0;         ///< of both, about the angle of a pixel
  float jump_rad = 0.0F;     ///< neighbours that differ by more belong to two surfaces

  /// The row of a plane angle, or null.
  [[nodiscard]] const float* row_at(double angle) const;
};

/// Resamples the first direction's phase of a camera on epipolar planes.
///
/// @missing  without rows when no pixel has a phase
[[nodiscard]] EpipolarRows epipolar_rows(const CameraPhases& camera,
                                         const Eigen::Isometry3d& camera_from_first,
                                         const EpipolarPlanes& planes,
                                         const PhaseSampler& sampler);

}  // namespace frangia
