#pragma once

#include <complex>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/geometry/mesh.h"
#include "frangia/geometry/ray_scene.h"
#include "frangia/indirect_light/surface_sight.h"
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

/// A measured surface under the projector, which predicts the light that its parts throw on each
/// other.
class LitSurface {
 public:
  /// @param mesh      with outward triangles, object frame; it may be open
  /// @param projector which lights it, rig frame
  /// @param patterns  fringes of one direction, coarse to fine; not empty
  LitSurface(Mesh mesh, Projector projector, std::vector<Pattern> patterns);

  /// The light on the point that a ray of the object frame meets first, and the ray's parameter
  /// there. The light is zero where the ray meets nothing, the inside of the surface, or a shadow.
  ///
  /// The integral over the hemisphere is a sum over 192 cells, over each of which the fringes are
  /// averaged. The same arguments give the same result. With `sight`, that of `look_around`, points
  /// that see no surface get no sum.
  [[nodiscard]] PointLight light_along(const Eigen::Isometry3d& rig_from_object,
                                       const Eigen::Vector3d& origin_mm,
                                       const Eigen::Vector3d& direction,
                                       double& distance,
                                       const SurfaceSight* sight = nullptr) const;

  /// Where the surface sees itself: for those that ask for the light on many points.
  [[nodiscard]] SurfaceSight look_around() const { return {scene_, step_off_mm_}; }

  [[nodiscard]] const Projector& projector() const { return projector_; }           ///< as given
  [[nodiscard]] const std::vector<Pattern>& patterns() const { return patterns_; }  ///< as given

 private:
  struct Hit {
    Eigen::Vector3d point_mm;
    Eigen::Vector3d normal;
  };
  [[nodiscard]] double direct_light(const Eigen::Isometry3d& rig_from_object, const Hit& on) const;
  [[nodiscard]] Eigen::Vector3d normal_at(const RayHit& hit) const;

  RayScene scene_;
  Projector projector_;
  std::vector<Pattern> patterns_;
  double step_off_mm_ = 0.0;  ///< of ray origins from the surface, far below an edge
};

}  // namespace frangia
