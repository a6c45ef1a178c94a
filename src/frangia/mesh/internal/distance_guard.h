#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "frangia/geometry/mesh.h"
#include "frangia/geometry/ray_scene.h"
#include "frangia/mesh/internal/collapse_topology.h"

namespace frangia {

/// Keeps a mesh during decimation within a distance of the original.
///
/// Sample points of the original (vertices, midpoints of edges, centroids of triangles) are each
/// assigned to a triangle of the present mesh. A collapse is allowed when every point assigned to a
/// changed triangle is within the distance of a remaining one, and points on the remaining
/// triangles, half the mean edge length apart, are within the distance of the original.
class DistanceGuard {
 public:
  DistanceGuard(const RayScene& original, const HalfEdges& edges, double distance_mm);

  /// Whether the edge from a to b may collapse to `target_mm`; `mesh` is the present one.
  [[nodiscard]] bool allows(const CollapseTopology& topology,
                            const Mesh& mesh,
                            std::uint32_t a,
                            std::uint32_t b,
                            const Eigen::Vector3d& target_mm);
  /// Reassigns the points after the collapse that was allowed last.
  void accept();

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;
  struct Triangle {
    std::uint32_t number;
    Eigen::Vector3d a, b, c;
  };
  void add_point(const Eigen::Vector3f& position, std::uint32_t triangle);
  void gather(const CollapseTopology& topology,
              const Mesh& mesh,
              std::uint32_t vertex,
              std::uint32_t other,
              const Eigen::Vector3d& target_mm);
  [[nodiscard]] std::uint32_t nearest_triangle(const Eigen::Vector3d& point) const;

  const RayScene* original_;
  double distance_mm_;
  double spacing_mm_;
  std::vector<Eigen::Vector3f> points_mm_;
  std::vector<std::uint32_t> next_;   ///< the next point of the same triangle
  std::vector<std::uint32_t> first_;  ///< the first point of each triangle
  std::vector<Triangle> remaining_;   ///< after the collapse
  std::vector<std::uint32_t> removed_;
  std::vector<std::uint32_t> reassigned_;  ///< points
  std::vector<std::uint32_t> owners_;      ///< the new triangle of each point
};

}  // namespace frangia
