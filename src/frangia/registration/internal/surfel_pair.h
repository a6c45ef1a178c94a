#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "frangia/local_fit/surfel_map.h"
#include "frangia/rig/camera_model.h"

namespace frangia {

/// Smallest cosine between the normals of two surfels of one surface. Up to 45 degrees, a
/// surface is still distinct from the other side of a thin wall and from the next face of a box,
/// and normals with the noise of grazing views still match.
inline constexpr double kMinNormalCosine = 0.7;

/// The surfel of a view that a point projects onto.
///
/// @units    mm, rig frame of the view
/// @missing  null when the point lies outside the image or behind the camera, or no surface was
///          measured there
/// @source   projective association: Blais & Levine 1995
[[nodiscard]] inline const SurfelMap::Surfel* surfel_at(const SurfelMap& map,
                                                        const FastCameraModel& model,
                                                        const Eigen::Vector3d& point_mm) {
  if (!(point_mm.z() > 0.0)) return nullptr;
  const Eigen::Vector3f point = point_mm.cast<float>();
  float u = 0.0F;
  float v = 0.0F;
  model.project(point.x(), point.y(), point.z(), u, v);
  const auto stride = static_cast<float>(map.stride);
  const float column = std::round(u / stride) - static_cast<float>(map.first_column);
  const float row = std::round(v / stride) - static_cast<float>(map.first_row);
  const bool within = column >= 0.0F && row >= 0.0F &&
                      column < static_cast<float>(map.surfels.width()) &&
                      row < static_cast<float>(map.surfels.height());
  if (!within) return nullptr;
  const SurfelMap::Surfel& surfel = map.surfels(static_cast<int>(column), static_cast<int>(row));
  return surfel.sigma_mm > 0.0F ? &surfel : nullptr;
}

/// A point of one view and the surfel of another view that it projects onto.
///
/// @units    mm, rig frame of the other view
struct SurfelPair {
  Eigen::Vector3d offset;         ///< from the target to the point
  Eigen::Vector3d target_normal;  ///< unit
  Eigen::Vector3d normal;         ///< unit, mean of both normals
  double normal_cosine = 0.0;     ///< between both normals
  /// Between both points. A motion of either surface changes the distance as it moves this point of
  /// it along `normal`, which turns half with each: so a motion of both changes nothing.
  Eigen::Vector3d middle;

  SurfelPair(const Eigen::Vector3d& point_mm,
             const Eigen::Vector3d& point_normal,
             const SurfelMap::Surfel& target)
      : offset(point_mm - target.point_mm.cast<double>()),
        target_normal(target.normal.cast<double>()),
        normal((target_normal + point_normal).normalized()),
        normal_cosine(target_normal.dot(point_normal)),
        middle(point_mm - 0.5 * offset) {}

  [[nodiscard]] bool faces_alike() const { return normal_cosine >= kMinNormalCosine; }

  /// Signed distance along the mean normal. On a curved surface the errors of both tangent planes
  /// cancel to second order.
  ///
  /// @source   symmetric point-to-plane distance: Rusinkiewicz 2019
  [[nodiscard]] double distance_mm() const { return normal.dot(offset); }

  /// Distance in front of the target from which on a point contradicts it: `least_mm`, and more
  /// than the noise of the two explains. Faces that are seen at grazing incidence have a large one.
  [[nodiscard]] static double margin_mm(double least_mm, double variance_mm2) {
    constexpr double kSigmas = 6.0;
    return std::max(least_mm, kSigmas * std::sqrt(variance_mm2));
  }

  /// Whether the point lies in front of the target by more than `margin_mm`, both along the normal
  /// and towards the camera: the other view looked through the place where the point is.
  [[nodiscard]] bool violates_free_space(double margin_mm) const {
    return target_normal.dot(offset) > margin_mm && -offset.z() > margin_mm;
  }
};

}  // namespace frangia
