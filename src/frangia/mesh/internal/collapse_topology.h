#pragma once

#include <cstdint>
#include <vector>

#include "frangia/geometry/half_edges.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// The adjacency of a mesh during edge collapses. Corner 3 t + i is corner i of triangle t, as in
/// HalfEdges. HalfEdges itself is immutable and keeps neighbours in arrays that cannot merge; here
/// the corners of a vertex form a linked list, so a collapse joins two lists.
class CollapseTopology {
 public:
  /// `mesh` must outlive the object; collapse() changes its triangles.
  CollapseTopology(Mesh& mesh, const HalfEdges& edges);

  /// Calls `work(corner)` for each corner of a remaining triangle at a vertex.
  template <typename Work>
  void for_each_corner(std::uint32_t vertex, const Work& work) const {
    for (std::uint32_t corner = first_[vertex]; corner != kNone; corner = next_corner_[corner])
      if (alive_[corner / 3] != 0) work(corner);
  }
  [[nodiscard]] std::uint32_t at(std::uint32_t corner) const {
    return mesh_->triangles[corner / 3][corner % 3];
  }
  [[nodiscard]] bool is_removed(std::uint32_t vertex) const { return first_[vertex] == kNone; }
  [[nodiscard]] bool is_fixed(std::uint32_t vertex) const { return fixed_[vertex] != 0; }
  [[nodiscard]] std::size_t remaining_triangles() const { return remaining_triangles_; }
  [[nodiscard]] const std::vector<std::uint8_t>& alive() const { return alive_; }

  /// The link condition: whether the mesh stays manifold when b collapses into a.
  ///
  /// @source   Dey, Edelsbrunner, Guha & Nekhayev 1999, Topology Preserving Edge Contraction
  [[nodiscard]] bool can_collapse(std::uint32_t a, std::uint32_t b);

  /// Collapses b into a and removes the triangles of the edge.
  void collapse(std::uint32_t a, std::uint32_t b);

  /// The vertices of the one-ring, each once.
  void neighbors(std::uint32_t vertex, std::vector<std::uint32_t>& found);

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;
  struct OneRingCounts {
    std::size_t triangles = 0;
    std::size_t shared_triangles = 0;
  };
  [[nodiscard]] OneRingCounts mark_neighbors(std::uint32_t a, std::uint32_t b, std::uint32_t stamp);

  Mesh* mesh_;
  std::size_t remaining_triangles_;
  std::uint32_t stamp_ = 0;
  std::vector<std::uint32_t> seen_;
  std::vector<std::uint8_t> fixed_;         ///< at non-manifold edges
  std::vector<std::uint8_t> on_boundary_;   ///< on a boundary
  std::vector<std::uint32_t> first_;        ///< a corner of each vertex
  std::vector<std::uint32_t> next_corner_;  ///< the next corner of the same vertex
  std::vector<std::uint8_t> alive_;
};

}  // namespace frangia
