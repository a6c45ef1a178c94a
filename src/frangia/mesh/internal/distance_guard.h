#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/run.h"
#include "frangia/geometry/connectivity.h"
#include "frangia/geometry/mesh.h"
#include "frangia/geometry/ray_scene.h"
#include "frangia/mesh/internal/edge_collapse.h"

namespace frangia {

/// A decimated mesh, and where it was near the original: what has not changed since then need not
/// be verified again.
struct CheckedSurface {
  Mesh mesh;
  std::vector<std::uint8_t> near;  ///< triangles of the mesh that are near the original
  std::vector<std::uint8_t>
      original_near;                 ///< triangles of the original that are near their owners
  std::vector<std::uint32_t> owner;  ///< the triangle of each vertex of the original
};

/// Keeps a mesh during decimation within a distance of the original.
///
/// Each vertex of the original is assigned to a triangle of the present mesh. A collapse is allowed
/// when every vertex that is assigned to a changed triangle is within the distance of a remaining
/// one, and the centroids and edges of those are within the distance of the original. That is
/// cheap; `vertices_beyond` verifies the result at many more points.
class DistanceGuard {
 public:
  /// `original` and its `edges` must outlive the object.
  DistanceGuard(const RayScene& original, const HalfEdges& edges, double distance_mm);

  /// Whether vertices of the original are so near to each other that the planes of a quadric stand
  /// for the surface. Coarse meshes of designs have longer edges.
  [[nodiscard]] bool is_fine() const;
  /// The root mean square distance from the planes of the original below which collapses of a fine
  /// mesh need no guard.
  [[nodiscard]] double plain_distance_mm() const;
  /// Assigns the vertices to a mesh that was decimated without the guard; `ends` states the vertex
  /// that each of them has become part of. Those without a triangle within the distance stay
  /// without one, for `vertices_beyond`.
  void assign(const CollapseTopology& topology,
              const Mesh& mesh,
              const std::vector<std::uint32_t>& ends);
  /// Whether the edge from a to b may collapse to `target_mm`; `mesh` is the present one. On a fine
  /// mesh, where its root mean square distance from the planes of the original is far less than the
  /// limit, the distance of the new triangles from the original is left to `vertices_beyond`.
  [[nodiscard]] bool allows(const CollapseTopology& topology,
                            const Mesh& mesh,
                            std::uint32_t a,
                            std::uint32_t b,
                            const CollapseTarget& target);
  /// Reassigns the vertices after the collapse that was allowed last.
  void accept();

  /// Vertices of the original at which one surface is farther than a distance from the other: at
  /// points a third of the original's mean edge length apart, of the original and of the triangles
  /// of the present mesh that `alive` states. `checked` is the result of an earlier call, or empty,
  /// and then that of this one.
  ///
  /// @errors   Error(Cancelled)
  [[nodiscard]] std::vector<std::uint32_t> vertices_beyond(const Mesh& mesh,
                                                           const std::vector<std::uint8_t>& alive,
                                                           double distance_mm,
                                                           CheckedSurface& checked,
                                                           const Run& run) const;

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;
  struct Triangle {
    std::uint32_t number;
    Eigen::Vector3d a, b, c;
  };
  /// Where the search for the original begins: near to the point before.
  struct Start {
    std::uint32_t vertex = kNone;    ///< of the original
    std::uint32_t triangle = kNone;  ///< of the original, near to which the point before was
  };
  void gather(const CollapseTopology& topology,
              const Mesh& mesh,
              std::uint32_t vertex,
              std::uint32_t other,
              const Eigen::Vector3d& target_mm);
  [[nodiscard]] std::uint32_t nearest_triangle(const Eigen::Vector3d& point) const;
  [[nodiscard]] std::uint32_t walk(const Eigen::Vector3d& point, std::uint32_t from) const;
  [[nodiscard]] bool is_near(const Eigen::Vector3d& point, double distance_mm, Start& start) const;
  void check_original(const Mesh& mesh,
                      const std::vector<std::uint8_t>& alive,
                      double distance_mm,
                      const std::vector<std::uint8_t>& same,
                      CheckedSurface& checked,
                      const Run& run,
                      std::vector<std::uint32_t>& beyond) const;
  void check_present(const Mesh& mesh,
                     const std::vector<std::uint8_t>& alive,
                     double distance_mm,
                     const std::vector<std::uint8_t>& same,
                     CheckedSurface& checked,
                     const Run& run,
                     std::vector<std::uint32_t>& beyond) const;

  const RayScene* original_;
  const HalfEdges* edges_;
  double distance_mm_;
  double spacing_mm_;
  std::vector<std::uint32_t> next_;   ///< the next vertex of the same triangle
  std::vector<std::uint32_t> first_;  ///< the first vertex of each triangle
  std::vector<Triangle> remaining_;   ///< after the collapse
  std::vector<std::uint32_t> removed_;
  std::vector<std::uint32_t> reassigned_;  ///< vertices
  std::vector<std::uint32_t> owners_;      ///< the new triangle of each of them
};

}  // namespace frangia
