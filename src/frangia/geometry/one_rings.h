#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "frangia/core/pixel_allocator.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

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
