#pragma once

#include <cstdint>
#include <span>
#include <vector>

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

}  // namespace frangia
