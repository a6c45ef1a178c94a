#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/pixel_buffer.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// The half-edges of a mesh: half-edge 3 t + i runs from corner i of triangle t to corner (i + 1)
/// % 3.
///
/// A half-edge has a twin when exactly one other runs in the opposite direction and no other in the
/// same direction. Elsewhere the mesh has a boundary or is not manifold. The time to build them is
/// linear in the number of triangles, times the logarithm of the valence at vertices of many.
/// @errors   Error(Input) when a triangle refers to a vertex that does not exist
class HalfEdges {
 public:
  static constexpr std::uint32_t kBoundary = 0xFFFFFFFF;  ///< no triangle on the other side
  static constexpr std::uint32_t kNonManifold =
      0xFFFFFFFE;  ///< several triangles, or one of opposite orientation

  /// Builds the half-edges; `mesh` is not needed afterwards.
  explicit HalfEdges(const Mesh& mesh);

  /// The opposite half-edge, `kBoundary` or `kNonManifold`.
  [[nodiscard]] std::uint32_t twin(std::uint32_t edge) const { return twins_[edge]; }
  /// Whether exactly one triangle of the same orientation is on the other side.
  [[nodiscard]] bool has_twin(std::uint32_t edge) const { return twins_[edge] < kNonManifold; }
  /// Whether no triangle is on the other side.
  [[nodiscard]] bool is_boundary(std::uint32_t edge) const { return twins_[edge] == kBoundary; }
  /// The number of half-edges: three per triangle.
  [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(twins_.size()); }

  /// Returns the half-edges that start at a vertex, one for each of its triangles, in ascending
  /// order.
  [[nodiscard]] std::span<const std::uint32_t> outgoing(std::uint32_t vertex) const {
    return std::span(edges_).subspan(first_[vertex], first_[vertex + 1] - first_[vertex]);
  }

  /// Returns the next half-edge of the same triangle.
  [[nodiscard]] static std::uint32_t next(std::uint32_t edge) {
    return edge % 3 == 2 ? edge - 2 : edge + 1;
  }
  /// Returns the previous half-edge of the same triangle.
  [[nodiscard]] static std::uint32_t previous(std::uint32_t edge) {
    return edge % 3 == 0 ? edge + 2 : edge - 1;
  }

 private:
  std::vector<std::uint32_t> twins_;
  std::vector<std::uint32_t> first_;
  std::vector<std::uint32_t> edges_;
};

/// Returns the vertex at which a half-edge starts.
[[nodiscard]] inline std::uint32_t source_vertex(const Mesh& mesh, std::uint32_t edge) {
  return mesh.triangles[edge / 3][edge % 3];
}
/// Returns the vertex at which a half-edge ends.
[[nodiscard]] inline std::uint32_t target_vertex(const Mesh& mesh, std::uint32_t edge) {
  return source_vertex(mesh, HalfEdges::next(edge));
}
/// Returns the vertex of a half-edge's triangle that is not on the half-edge.
[[nodiscard]] inline std::uint32_t opposite_vertex(const Mesh& mesh, std::uint32_t edge) {
  return source_vertex(mesh, HalfEdges::previous(edge));
}

/// A triangle at an edge.
struct EdgeSide {
  Eigen::Vector3d apex_mm;  ///< the corner that is not on the edge, mm
  bool upward = false;      ///< whether the triangle runs from the edge's first end to the second
  std::uint32_t shell = 0;  ///< what it is connected with over edges of two triangles
};

/// The partner of a side that has none.
inline constexpr std::size_t kNoPartner = std::numeric_limits<std::size_t>::max();

/// Whether the triangles of a mesh are clockwise seen from outside, by the volume that they
/// enclose. Its sides enclose material where `upward` is exchanged.
[[nodiscard]] bool is_inside_out(const Mesh& mesh);

/// Pairs the triangles that meet at an edge so that shells which touch there stay apart: two of one
/// shell are a pair unless they are front and back of one face; the others are paired as they
/// enclose material, behind an upward side, against the sense of rotation, the next downward one.
///
/// @shape    the partner of each side, by its index
/// @missing  kNoPartner
[[nodiscard]] std::vector<std::size_t> pair_sides(const Eigen::Vector3d& first_end_mm,
                                                  const Eigen::Vector3d& second_end_mm,
                                                  std::span<const EdgeSide> sides);

/// Whether `vertex` is a corner of the triangle.
[[nodiscard]] inline bool has_vertex(const Mesh::Triangle& t, std::uint32_t vertex) {
  return t[0] == vertex || t[1] == vertex || t[2] == vertex;
}

/// Whether a triangle was marked as removed by setting all its corners to one vertex.
[[nodiscard]] inline bool is_removed(const Mesh::Triangle& t) {
  return t[0] == t[1];
}

/// The triangles around the vertices of a mesh, in ascending order. Removed triangles are left out.
///
/// It does not follow changes of the mesh. For the twins of edges, see HalfEdges.
class OneRings {
 public:
  /// Collects the rings of all vertices.
  explicit OneRings(const Mesh& mesh);
  /// Collects the rings of some vertices, which may be listed several times.
  OneRings(const Mesh& mesh, std::span<const std::uint32_t> vertices);

  /// Returns the triangles around a vertex, which must be one of those collected.
  [[nodiscard]] std::span<const std::uint32_t> of(std::uint32_t vertex) const {
    const std::uint32_t ring = ring_of_.empty() ? vertex : ring_of_[vertex];
    return {triangles_.data() + first_[ring], triangles_.data() + first_[ring + 1]};
  }
  /// Returns the triangles of all rings of selected vertices, in ascending order, each once. It is
  /// empty when the rings of all vertices were collected.
  [[nodiscard]] const std::vector<std::uint32_t>& selected_triangles() const { return selected_; }

 private:
  LargeVector<std::uint32_t> ring_of_;  ///< of each vertex; empty: the vertex itself
  LargeVector<std::uint32_t> first_;
  LargeVector<std::uint32_t> triangles_;
  std::vector<std::uint32_t> selected_;
};

/// Returns the neighbours of `v` in ascending order, once for each triangle that connects them:
/// twice across an inner edge, once across a boundary edge.
[[nodiscard]] std::vector<std::uint32_t> one_ring_neighbors(const Mesh& mesh,
                                                            const OneRings& one_rings,
                                                            std::uint32_t v);

/// Returns a vertex and the vertices connected to it by at most `rings` edges and within `reach_mm`
/// of it, in breadth-first order.
[[nodiscard]] std::vector<std::uint32_t> vertices_within(
    const Mesh& mesh, const OneRings& one_rings, std::uint32_t vertex, int rings, float reach_mm);

}  // namespace frangia
