#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "frangia/core/image.h"
#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"
#include "frangia/geometry/ray_scene.h"
#include "frangia/rig/rig.h"
#include "frangia/simulate/simulate_options.h"

namespace frangia {

/// A part on the simulated rig.
struct SimulatedScene {
  RayScene surface;  ///< the part and the turntable top, object frame
  std::vector<std::array<Eigen::Vector3f, 3>> normals;  ///< three per triangle, for shading
  Rig rig;                                              ///< with its faults
  Rig known_rig;                                        ///< without its faults, for rig.toml
  Image<Eigen::Vector2f> rays;
  Eigen::Isometry3d part_from_object = Eigen::Isometry3d::Identity();  ///< of a printed board
  double working_distance_mm = 0.0;  ///< of the projector from the part
  double exposure = 1.0;             ///< white level per unit of light from a white surface
  SimulateOptions options = {};
  std::size_t camera = 0;  ///< that `rig` is seen from; 0 is the reference camera
};

/// One station of the turntable.
struct SimulatedView {
  std::size_t index = 0;
  double angle_rad = 0.0;    ///< commanded
  double drift_share = 0.0;  ///< of the drift during the scan, from 0 to 1
};

/// Places a part on a rig and sets the exposure by the brightest pixel of all views. `part_pose` is
/// the pose already applied to `part`; it locates the plane of a printed board. The rigs of the
/// scene are those of `camera`, see `rig_of_camera`; the known rig of the reference camera keeps
/// them all.
///
/// @errors   Error(Input) when the part has no triangles, the rig has no turntable, or an option is
///          out of range; Error(Cancelled)
[[nodiscard]] SimulatedScene make_simulated_scene(
    const Mesh& part,
    const Rig& rig,
    std::span<const SimulatedView> views,
    const SimulateOptions& options = {},
    const Eigen::Isometry3d& part_pose = Eigen::Isometry3d::Identity(),
    const Run& run = {},
    std::size_t camera = 0);

/// The true pose of the object in a view, with the turntable's faults.
[[nodiscard]] Eigen::Isometry3d true_pose(const SimulatedScene& scene, const SimulatedView& view);

/// Parameters of one frame: the projected light, the camera settings and the noise stream.
struct Shot {
  double cos_shift = 1.0;
  double sin_shift = 0.0;
  std::uint64_t stream = 0;
  double light = 1.0;         ///< factor on the scene's exposure
  double projector = 1.0;     ///< share of the projector's light that is on
  double lamp = 0.0;          ///< ambient light of another lamp, as `SimulateOptions::ambient`
  double gain = 1.0;          ///< factor on the scene's counts per electron
  double black_counts = 0.0;  ///< added to all pixels
  int clips_at_counts = 0;    ///< no pixel has more; 0: no such limit
  /// Picture of a digital projector that replaces the pattern, linear, 0 to 1.
  const Image<float>* picture = nullptr;
  /// Pictures that a part of the exposure saw instead: a share of it each.
  std::vector<std::pair<const Image<float>*, double>> before = {};
};

/// A rectangular sheet about the origin. Its face lies in z = 0 and faces -z; its body of 3 mm lies
/// at z > 0.
///
/// @units    mm; `half` holds half of the sides along x and y
[[nodiscard]] Mesh make_sheet(const Eigen::Vector2d& half);

/// Reflectance of a coloured surface in red, green and blue: bands of changing hue. Each channel
/// varies from 1 to 1 - strength as a sine along a skew direction, with a period of 40 mm and a
/// third of a period between the channels.
///
/// @units    mm, frame of the part
[[nodiscard]] Eigen::Vector3d surface_color(const Eigen::Vector3d& position_mm, double strength);

/// The share of light that a grey camera sees of a color.
///
/// @source   ITU-R BT.601
[[nodiscard]] double luminance_of_color(const Eigen::Vector3d& color);

}  // namespace frangia
