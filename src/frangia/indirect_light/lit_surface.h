#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/geometry/mesh.h"
#include "frangia/geometry/ray_scene.h"
#include "frangia/pattern/pattern.h"
#include "frangia/rig/projector.h"

namespace frangia {

/// Light on a point of the surface while the projector shows fringes, in the same arbitrary unit
/// for all points.
struct PointLight {
  double direct = 0.0;  ///< from the projector; 0 in shadow
  /// From other parts of the surface, if they reflect all their light diffusely: the mean light ...
  double indirect = 0.0;
  /// ... what may come from directions in which the surface was not measured ...
  double unknown = 0.0;
  /// ... and, for each pattern, the amplitude and the absolute phase of the fringes in it.
  std::vector<std::complex<double>> fringes;
};

/// A point of the surface and its normal, object frame.
struct ShadedPoint {
  Eigen::Vector3d point_mm;  ///< object frame
  Eigen::Vector3d normal;    ///< unit, outward
};

/// What a cell of the hemisphere about a point of the surface meets.
struct SeenPatch {
  RayHit hit;              ///< of the ray through the middle of the cell
  ShadedPoint at;          ///< there, with the shading normal
  bool is_inside = false;  ///< the ray meets the inside of the surface, through a hole
  /// Where the middles of the cell's sides meet the plane of the hit: across the rings, and along
  /// its ring; NaN where they do not meet it.
  std::array<std::array<Eigen::Vector3d, 2>, 2> sides_mm;
};

/// A measured surface under the projector, which predicts the light that its parts throw on each
/// other.
class LitSurface {
 public:
  static constexpr int kCells = 192;  ///< of the hemisphere about a point

  /// @param mesh      with outward triangles, object frame; it may be open
  /// @param projector which lights it, rig frame
  /// @param patterns  fringes of one direction, coarse to fine; not empty
  LitSurface(Mesh mesh, Projector projector, std::vector<Pattern> patterns);

  /// The light on the point that a ray of the object frame meets first, and the ray's parameter
  /// there. The light is zero where the ray meets nothing, the inside of the surface, or a shadow.
  ///
  /// The integral over the hemisphere is a sum over 192 cells, over each of which the fringes are
  /// averaged. The same arguments give the same result.
  [[nodiscard]] PointLight light_along(const Eigen::Isometry3d& rig_from_object,
                                       const Eigen::Vector3d& origin_mm,
                                       const Eigen::Vector3d& direction,
                                       double& distance) const;

  /// What the cells of the hemisphere about a point meet, of equal cosine-weighted solid angles.
  /// Where a quarter of them, spread over the hemisphere, meets nothing, the others are not traced.
  [[nodiscard]] std::vector<SeenPatch> look_around(const ShadedPoint& from) const;
  /// Whether a quarter of these directions meet something.
  [[nodiscard]] bool sees_something(const ShadedPoint& from) const;
  /// The direct light of the projector at this place of the object frame; 0 in shadow.
  [[nodiscard]] double direct_light(const Eigen::Isometry3d& rig_from_object,
                                    const Eigen::Vector3d& lamp_mm,
                                    const ShadedPoint& on) const;
  /// The interpolated normal at a hit; a corner on a crease takes part with the triangle's normal.
  [[nodiscard]] Eigen::Vector3d normal_at(const RayHit& hit) const;
  /// Whether a corner of a triangle lies on a crease, where its vertex has another normal.
  [[nodiscard]] bool is_on_crease(std::size_t triangle, std::size_t corner) const;
  /// Adds the light of a patch, a cell of `kCells`, with the phase of the finest fringes there and
  /// its extents over the cell.
  void add(double light,
           double phase_rad,
           const std::array<double, 2>& extents_rad,
           PointLight& to) const;
  /// The light that an unmeasured part of the surface in one cell may throw on a point.
  [[nodiscard]] static double unknown_light(const Eigen::Vector3d& lamp_mm,
                                            const Eigen::Vector3d& point_mm);

  [[nodiscard]] const RayScene& scene() const { return scene_; }                    ///< its mesh
  [[nodiscard]] const Projector& projector() const { return projector_; }           ///< as given
  [[nodiscard]] const std::vector<Pattern>& patterns() const { return patterns_; }  ///< as given

 private:
  [[nodiscard]] std::optional<SeenPatch> look(const ShadedPoint& from,
                                              const Eigen::Matrix3d& turned,
                                              std::size_t cell) const;

  RayScene scene_;
  Projector projector_;
  std::vector<Pattern> patterns_;
  std::vector<double> ratios_;  ///< fringes of each pattern over those of the finest
  double step_off_mm_ = 0.0;    ///< of ray origins from the surface, far below an edge
};

}  // namespace frangia
