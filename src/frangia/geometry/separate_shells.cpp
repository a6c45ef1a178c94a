#include "frangia/geometry/separate_shells.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "frangia/core/disjoint_sets.h"
#include "frangia/geometry/half_edges.h"
#include "frangia/geometry/pair_sides.h"
#include "frangia/geometry/vertex_data.h"

namespace frangia {
namespace {

/// The half-edges without a single twin, sorted so that those of one edge follow each other.
class OddEdges {
 public:
  OddEdges(const Mesh& mesh, const HalfEdges& edges) {
    for (std::uint32_t edge = 0; edge < edges.count(); ++edge) {
      if (edges.has_twin(edge) || edges.is_boundary(edge)) continue;
      const auto ends = std::minmax({source_vertex(mesh, edge), target_vertex(mesh, edge)});
      if (ends.first != ends.second) sides_.push_back({ends.first, ends.second, edge});
    }
    std::sort(sides_.begin(), sides_.end());
  }

  /// Calls `work(sides)` with the half-edges of each edge, in ascending order.
  template <typename Work>
  void each(const Work& work) const {
    std::vector<std::uint32_t> at_edge;
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      at_edge.push_back(std::get<2>(sides_[i]));
      const bool is_last = i + 1 == sides_.size() ||
                           std::get<0>(sides_[i + 1]) != std::get<0>(sides_[i]) ||
                           std::get<1>(sides_[i + 1]) != std::get<1>(sides_[i]);
      if (!is_last) continue;
      work(std::as_const(at_edge));
      at_edge.clear();
    }
  }

 private:
  /// The lower and the higher vertex, and the half-edge.
  std::vector<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>> sides_;
};

/// What is connected over edges of two triangles, by triangle.
DisjointSets shells_of(const Mesh& mesh, const HalfEdges& edges, const OddEdges& odd) {
  DisjointSets shells(mesh.triangles.size());
  for (std::uint32_t edge = 0; edge < edges.count(); ++edge)
    if (edges.has_twin(edge)) shells.join(edge / 3, edges.twin(edge) / 3);
  odd.each([&](std::span<const std::uint32_t> sides) {
    if (sides.size() == 2) shells.join(sides[0] / 3, sides[1] / 3);
  });
  return shells;
}

/// Joins the corners at both ends of two sides of one edge. A corner is the half-edge that begins
/// there.
void join_ends(const Mesh& mesh, std::uint32_t a, std::uint32_t b, DisjointSets& corners) {
  const bool opposite = source_vertex(mesh, a) != source_vertex(mesh, b);
  corners.join(a, opposite ? HalfEdges::next(b) : b);
  corners.join(HalfEdges::next(a), opposite ? b : HalfEdges::next(b));
}

/// Joins the sides of an edge of several triangles in pairs; those without a partner stay together.
void join_sides(const Mesh& mesh,
                std::span<const std::uint32_t> sides,
                bool inside_out,
                DisjointSets& shells,
                DisjointSets& corners) {
  const std::uint32_t first = source_vertex(mesh, sides[0]);
  const std::uint32_t second = target_vertex(mesh, sides[0]);
  std::vector<EdgeSide> at_edge;
  at_edge.reserve(sides.size());
  for (const std::uint32_t side : sides)
    at_edge.push_back({mesh.vertices_mm[opposite_vertex(mesh, side)].cast<double>(),
                       (source_vertex(mesh, side) == first) != inside_out,
                       shells.find(side / 3)});
  const std::vector<std::size_t> partner = pair_sides(
      mesh.vertices_mm[first].cast<double>(), mesh.vertices_mm[second].cast<double>(), at_edge);
  std::size_t alone = kNoPartner;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (partner[i] == kNoPartner && alone == kNoPartner) alone = i;
    join_ends(mesh, sides[i], sides[partner[i] == kNoPartner ? alone : partner[i]], corners);
  }
}

/// Gives each set of corners at a vertex but the first a copy of the vertex.
void split_vertices(Mesh& mesh, DisjointSets& corners) {
  constexpr std::uint32_t kNone = 0xFFFFFFFF;
  std::vector<std::uint32_t> owner(mesh.vertices_mm.size(), kNone);  // the set that keeps a vertex
  std::vector<std::uint32_t> added(3 * mesh.triangles.size(), kNone);
  std::uint32_t corner = 0;
  for (Mesh::Triangle& triangle : mesh.triangles) {
    for (std::uint32_t& vertex : triangle) {
      const std::uint32_t set = corners.find(corner++);
      if (owner[vertex] == kNone) owner[vertex] = set;
      if (owner[vertex] == set) continue;
      if (added[set] == kNone) added[set] = copy_vertex(mesh, vertex);
      vertex = added[set];
    }
  }
}

}  // namespace

Mesh separate_shells(Mesh mesh) {
  const HalfEdges edges(mesh);
  const OddEdges odd(mesh, edges);
  DisjointSets corners(edges.count());
  for (std::uint32_t edge = 0; edge < edges.count(); ++edge)
    if (edges.has_twin(edge)) corners.join(edge, HalfEdges::next(edges.twin(edge)));
  DisjointSets shells = shells_of(mesh, edges, odd);
  const bool inside_out = is_inside_out(mesh);
  odd.each([&](std::span<const std::uint32_t> sides) {
    if (sides.size() == 2)
      join_ends(mesh, sides[0], sides[1], corners);
    else
      join_sides(mesh, sides, inside_out, shells, corners);
  });
  split_vertices(mesh, corners);
  return mesh;
}

}  // namespace frangia
