#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/image.h"
#include "frangia/geometry/ray_scene.h"
#include "frangia/rig/rig.h"
#include "frangia/simulate/simulate_options.h"

namespace frangia {

/// A part on the simulated rig, ready to be photographed.
struct SimulatedScene {
  RayScene surface;  ///< the part and the turntable top, object frame
  std::vector<std::array<Eigen::Vector3f, 3>> normals;  ///< three a triangle, for the light
  Rig rig;                                              ///< as it really is
  Rig known_rig;                                        ///< as rig.toml tells it
  Image<Eigen::Vector2f> rays;
  double working_distance_mm = 0.0;  ///< of the projector from the part
  double exposure = 1.0;             ///< white level per unit of light from a white surface
  SimulateOptions options = {};
};

/// One stop of the turntable.
struct SimulatedView {
  std::size_t index = 0;
  double angle_rad = 0.0;  ///< commanded
};

/// Puts a part on a rig and sets the exposure for all the views that are to come.
///
/// errors   Error(Input) when the part is empty or the rig has no turntable, or when an option has
/// a
///          value that makes no sense, which the sentence names
[[nodiscard]] SimulatedScene make_simulated_scene(const Mesh& part,
                                                  const Rig& rig,
                                                  std::span<const SimulatedView> views,
                                                  const SimulateOptions& options = {});

/// Where the object really stands in a view: with the turntable's faults.
[[nodiscard]] Eigen::Isometry3d true_pose(const SimulatedScene& scene, const SimulatedView& view);

}  // namespace frangia
