#pragma once

#include <array>

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

/// Traces one ray of the camera.
///
/// @missing  all values are 0 where the ray hits nothing; only the albedo is set in shadow and
/// outside
///          of the projector's field
[[nodiscard]] LightSample sample_light(const SimulatedScene& scene,
                                       const Eigen::Isometry3d& rig_from_object,
                                       const Eigen::Vector2d& ray);

}  // namespace frangia
