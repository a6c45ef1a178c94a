#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>

#include <Eigen/Core>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// Where a ray meets the surface.
struct RayHit {
  double distance = 0.0;        ///< along the ray, in lengths of its direction
  std::uint32_t triangle = 0;   ///< index into the mesh
  Eigen::Vector3d barycentric;  ///< weights of the triangle's three corners, sum 1
  Eigen::Vector3d normal;       ///< of the triangle, unit, outward
};

/// The point of the surface nearest to another one.
struct NearestPoint {
  Eigen::Vector3d point_mm;
  double distance_mm = 0.0;         ///< never negative
  double signed_distance_mm = 0.0;  ///< positive outside, by the triangle's normal
  std::uint32_t triangle = 0;
};

/// A mesh that answers geometric questions fast. Queries may come from any number of threads.
///
/// Embree finds the triangle in single precision; its plane then gives the answer in double.
/// missing  triangles without area, or with a corner that is not finite, are not there
/// errors   Error(Input) when a triangle names a vertex that the mesh does not have
/// source   Embree (Wald et al. 2014)
class RayScene {
 public:
  explicit RayScene(Mesh mesh);
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;
  RayScene(RayScene&& other) noexcept;
  RayScene& operator=(RayScene&& other) noexcept;
  ~RayScene();

  [[nodiscard]] const Mesh& mesh() const { return mesh_; }

  /// The first hit of origin + t * direction with t in [0, max_distance]; both sides count.
  [[nodiscard]] std::optional<RayHit> first_hit(
      const Eigen::Vector3d& origin_mm,
      const Eigen::Vector3d& direction,
      double max_distance = std::numeric_limits<double>::infinity()) const;

  /// Whether anything lies between two points. For one that is itself on the surface, step off it.
  [[nodiscard]] bool occluded(const Eigen::Vector3d& from_mm, const Eigen::Vector3d& to_mm) const;

  /// The nearest point of the surface, or nothing when all of it is farther than `max_distance_mm`.
  /// Of triangles that share the nearest point the one seen most squarely gives the sign.
  [[nodiscard]] std::optional<NearestPoint> nearest(
      const Eigen::Vector3d& point_mm,
      double max_distance_mm = std::numeric_limits<double>::infinity()) const;

 private:
  struct Embree;
  Mesh mesh_;
  std::unique_ptr<Embree> embree_;
};

}  // namespace frangia
