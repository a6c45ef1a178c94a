#pragma once

#include <array>
#include <optional>

#include <Eigen/Geometry>

#include "frangia/simulate/internal/simulated_scene.h"

namespace frangia {

/// The light along one camera ray.
struct LightSample {
  float u = 0.0F;  ///< where the light left the projector: psi in nominal degrees, or its column
  float v = 0.0F;  ///< its row; pinhole only
  float diffuse = 0.0F;  ///< light of the fully lit projector, 1 on a white surface that faces it
  float glossy = 0.0F;   ///< the highlight on top of it
  float line = 0.0F;     ///< share of the laser sheet's peak that falls here
  float albedo = 0.0F;   ///< 0 where the ray meets nothing
  std::array<float, 3> tint{1.0F, 1.0F, 1.0F};  ///< red, green and blue over the grey reflectance

  [[nodiscard]] float reflected() const { return diffuse + glossy; }
};

/// A point of the surface that a ray meets, in the object frame.
struct SurfacePoint {
  Eigen::Vector3d point_mm;
  Eigen::Vector3d face_normal;  ///< of the triangle, unit, towards the ray's origin
  Eigen::Vector3d normal;       ///< for shading, interpolated from the vertices, unit
  float albedo = 0.0F;          ///< of the texture: 1 for white
  std::array<float, 3> tint{1.0F, 1.0F, 1.0F};  ///< as in `LightSample`
  double distance = 0.0;                        ///< along the ray, in units of its direction vector

  /// The point moved off the surface, as the origin of another ray.
  [[nodiscard]] Eigen::Vector3d off_surface() const {
    constexpr double kStepOff_mm = 2e-3;  // above the rounding of single precision
    return point_mm + kStepOff_mm * face_normal;
  }
};

/// Returns what a ray of the object frame meets first.
[[nodiscard]] std::optional<SurfacePoint> find_surface_point(const SimulatedScene& scene,
                                                             const Eigen::Vector3d& origin,
                                                             const Eigen::Vector3d& direction);

/// Returns where the projector shows a point of the rig frame, in the units of `LightSample`, also
/// outside of its field; nothing for a point behind it.
[[nodiscard]] std::optional<Eigen::Vector2d> projector_coordinate(const Projector& projector,
                                                                  const Eigen::Vector3d& point);

/// Returns the projector's light on a point of the surface; `in_rig` is the point in the rig frame.
///
/// @missing  only the albedo is set in shadow and outside of the projector's field; no highlight
[[nodiscard]] LightSample light_on(const SimulatedScene& scene,
                                   const Eigen::Isometry3d& object_from_rig,
                                   const SurfacePoint& on,
                                   const Eigen::Vector3d& in_rig);

/// Traces one ray of the camera.
///
/// @missing  all values are 0 where the ray hits nothing; only the albedo is set in shadow and
///          outside of the projector's field
[[nodiscard]] LightSample sample_light(const SimulatedScene& scene,
                                       const Eigen::Isometry3d& rig_from_object,
                                       const Eigen::Vector2d& ray);

}  // namespace frangia
