#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/indirect_light/lit_surface.h"

namespace frangia {

/// Whether two poses are the same, but for rounding.
[[nodiscard]] bool is_same_pose(const Eigen::Isometry3d& one, const Eigen::Isometry3d& other);

/// The light that parts of a surface throw on each other, collected at its vertices for all poses
/// in which it was measured.
///
/// What a vertex sees does not depend on the pose: it is looked for once, and each pose lights it.
/// Between the vertices of a triangle light is interpolated. A corner on a crease has a point of
/// its own in each triangle, with that triangle's normal.
class SurfaceLight {
 public:
  /// `poses` are rig from object, of all views whose light is asked for.
  SurfaceLight(std::shared_ptr<const LitSurface> surface, std::span<const Eigen::Isometry3d> poses);

  [[nodiscard]] const LitSurface& surface() const { return *surface_; }  ///< as given

  /// Which of the poses this one is; none where it is another.
  [[nodiscard]] std::optional<std::size_t> pose_of(const Eigen::Isometry3d& rig_from_object) const;
  /// As `LitSurface::light_along`, in one of the poses.
  [[nodiscard]] PointLight light_along(std::size_t pose,
                                       const Eigen::Vector3d& origin_mm,
                                       const Eigen::Vector3d& direction,
                                       double& distance) const;
  /// Points of the surface that see other parts of it: only for them light is summed up.
  [[nodiscard]] std::size_t receivers() const { return receivers_; }

 private:
  /// A pose, the light of the projector at the vertices, and what the receivers collect of it.
  struct Pose {
    Eigen::Isometry3d rig_from_object;
    Eigen::Vector3d lamp_mm;        ///< the projector, object frame
    std::vector<float> lit;         ///< by vertex: 1 where the projector sees it, else 0
    std::vector<double> phase_rad;  ///< by vertex, of the finest fringes
    std::vector<float> collected;   ///< by receiver: mean, unknown, and fringes; NaN: faces away
  };
  static constexpr std::uint32_t kNothing = UINT32_MAX;  ///< no receiver

  [[nodiscard]] std::vector<ShadedPoint> place_points();
  void light_vertices(Pose& pose) const;
  void collect(const std::vector<ShadedPoint>& points);
  void collect_at(std::size_t receiver,
                  const ShadedPoint& point,
                  const std::vector<SeenPatch>& patches);
  [[nodiscard]] std::size_t values() const { return 2 + 2 * surface_->patterns().size(); }

  std::shared_ptr<const LitSurface> surface_;
  std::vector<Pose> poses_;
  std::vector<char> is_long_;  ///< by triangle: light is not interpolated over it
  /// Of the corners of each triangle: the point, later the receiver there.
  std::vector<std::array<std::uint32_t, 3>> corners_;
  std::size_t receivers_ = 0;
};

}  // namespace frangia
