#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// The intersection of a ray with the surface.
struct RayHit {
  double distance = 0.0;        ///< along the ray, in units of its direction vector
  std::uint32_t triangle = 0;   ///< index into the mesh
  Eigen::Vector3d barycentric;  ///< weights of the triangle's corners; their sum is 1
  Eigen::Vector3d normal;       ///< of the triangle, unit, outward
};

/// The point of the surface nearest to a query point.
struct NearestPoint {
  Eigen::Vector3d point_mm;         ///< nearest point, on the surface
  double distance_mm = 0.0;         ///< never negative
  double signed_distance_mm = 0.0;  ///< positive on the side of the triangle's normal
  std::uint32_t triangle = 0;       ///< index into the mesh
};

/// A mesh with fast ray and nearest-point queries, which may come from several threads.
///
/// Embree finds the triangle in single precision; the result is then computed in double precision.
/// @units    mm
/// @missing  triangles without area, or with a corner that is not finite, are ignored; a ray with a
///          coordinate that is not finite or beyond 1e18 hits nothing
/// @errors   Error(Input) when a triangle refers to a vertex that does not exist; Error(Cancelled)
/// @source   Embree: Wald et al. 2014
class RayScene {
 public:
  /// Builds the search structure and keeps the mesh.
  explicit RayScene(Mesh mesh, const Run& run = {});
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;
  /// Takes over the mesh and the search structure.
  RayScene(RayScene&& other) noexcept;
  /// Takes over the mesh and the search structure.
  RayScene& operator=(RayScene&& other) noexcept;
  ~RayScene();

  /// Mesh that was passed to the constructor.
  [[nodiscard]] const Mesh& mesh() const { return mesh_; }

  /// Returns the first hit of origin + t * direction with t in [0, max_distance], from either side.
  [[nodiscard]] std::optional<RayHit> first_hit(
      const Eigen::Vector3d& origin_mm,
      const Eigen::Vector3d& direction,
      double max_distance = std::numeric_limits<double>::infinity()) const;

  /// Whether the surface intersects the segment between two points. A point on the surface must be
  /// moved off it first.
  [[nodiscard]] bool occluded(const Eigen::Vector3d& from_mm, const Eigen::Vector3d& to_mm) const;

  /// Returns the nearest point of the surface within `max_distance_mm`, if there is one. Of the
  /// triangles that share it, the one whose normal is nearest to the direction gives the sign.
  [[nodiscard]] std::optional<NearestPoint> nearest(
      const Eigen::Vector3d& point_mm,
      double max_distance_mm = std::numeric_limits<double>::infinity()) const;

 private:
  struct Embree;
  Mesh mesh_;
  double size_mm_ = 0.0;  ///< of the bounding box
  /// Triangles that Embree searches, ascending; empty: all. A repeated triangle is left out, since
  /// queries visit every triangle at the same place.
  std::vector<std::uint32_t> searched_;
  std::unique_ptr<Embree> embree_;
};

}  // namespace frangia
