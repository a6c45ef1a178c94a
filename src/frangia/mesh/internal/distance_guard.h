#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "frangia/geometry/mesh.h"
#include "frangia/geometry/ray_scene.h"
#include "frangia/mesh/internal/collapse_topology.h"

namespace frangia {

/// Keeps a mesh that is being simplified within a distance of what it was.
///
/// Points of the original (its vertices, the middles of its edges and triangles) each belong to a
/// triangle of the present mesh. A join is allowed when every point of the triangles that it
/// touches lies within the distance of one of those that remain, and these lie as near to the
/// original, at points twice as dense as its own.
class DistanceGuard {
 public:
  DistanceGuard(const RayScene& original, const HalfEdges& edges, double distance_mm);

  /// Whether a and b may become one at `joint`; `mesh` is the present one.
  [[nodiscard]] bool allows(const CollapseTopology& topology,
                            const Mesh& mesh,
                            std::uint32_t a,
                            std::uint32_t b,
                            const Eigen::Vector3d& target_mm);
  /// The join that was allowed last is made.
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
  std::vector<std::uint32_t> first_;  ///< the first of each triangle
  std::vector<Triangle> remaining_;   ///< as they would be
  std::vector<std::uint32_t> removed_;
  std::vector<std::uint32_t> reassigned_;  ///< points, with the triangle that each would belong to
  std::vector<std::uint32_t> owners_;
};

}  // namespace frangia
