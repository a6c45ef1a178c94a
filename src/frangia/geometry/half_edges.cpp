#include "frangia/geometry/half_edges.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <unordered_map>
#include <vector>

#include "frangia/core/error.h"
#include "frangia/core/parallel.h"

namespace frangia {
namespace {

constexpr std::size_t kEdgesPerChunk = 16'384;

/// Finds half-edges by their ends. A vertex of high valence gets its outgoing half-edges sorted by
/// target, so that a search there does not visit all of them.
class EdgeFinder {
 public:
  EdgeFinder(const Mesh& mesh, const HalfEdges& edges) : mesh_(mesh), edges_(edges) {
    for (std::uint32_t v = 0; v < mesh.vertices_mm.size(); ++v) {
      if (edges.outgoing(v).size() <= kLinearSearch) continue;
      std::vector<std::uint32_t>& sorted = sorted_[v];
      sorted.assign(edges.outgoing(v).begin(), edges.outgoing(v).end());
      std::stable_sort(sorted.begin(), sorted.end(), [&](std::uint32_t a, std::uint32_t b) {
        return target_vertex(mesh, a) < target_vertex(mesh, b);
      });
    }
  }

  struct Matches {
    std::uint32_t first = 0;  ///< undefined without a match
    std::size_t count = 0;
  };
  [[nodiscard]] Matches find(std::uint32_t from, std::uint32_t to) const {
    Matches matches;
    const std::span<const std::uint32_t> outgoing = edges_.outgoing(from);
    if (outgoing.size() > kLinearSearch) {
      const std::vector<std::uint32_t>& sorted = sorted_.at(from);
      const auto begin = std::partition_point(sorted.begin(), sorted.end(), [&](std::uint32_t e) {
        return target_vertex(mesh_, e) < to;
      });
      const auto end = std::partition_point(
          begin, sorted.end(), [&](std::uint32_t e) { return target_vertex(mesh_, e) == to; });
      matches.count = static_cast<std::size_t>(end - begin);
      if (begin != end) matches.first = *begin;
      return matches;
    }
    for (const std::uint32_t edge : outgoing) {
      if (target_vertex(mesh_, edge) == to && matches.count++ == 0) matches.first = edge;
    }
    return matches;
  }

 private:
  static constexpr std::size_t kLinearSearch = 32;  // half-edges; a typical valence is 6
  const Mesh& mesh_;
  const HalfEdges& edges_;
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> sorted_;
};

}  // namespace

HalfEdges::HalfEdges(const Mesh& mesh) {
  require(mesh.triangles.size() < kNonManifold / 3,
          "HalfEdges: more than 1.4 billion triangles; decimate the mesh first");
  const std::size_t vertices = mesh.vertices_mm.size();
  first_.assign(vertices + 1, 0);
  for (const Mesh::Triangle& triangle : mesh.triangles) {
    require(std::max({triangle[0], triangle[1], triangle[2]}) < vertices,
            "HalfEdges: a triangle refers to a vertex that does not exist; repair the mesh first");
    for (const std::uint32_t vertex : triangle)
      ++first_[vertex + 1];
  }
  for (std::size_t v = 1; v < first_.size(); ++v)
    first_[v] += first_[v - 1];
  const std::size_t edges = 3 * mesh.triangles.size();
  edges_.resize(edges);
  twins_.resize(edges);
  for (std::uint32_t e = 0; e < edges; ++e)
    edges_[first_[source_vertex(mesh, e)]++] = e;
  for (std::size_t v = vertices; v > 0; --v)
    first_[v] = first_[v - 1];
  first_[0] = 0;
  const EdgeFinder finder(mesh, *this);
  parallel_chunks(edges, kEdgesPerChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto edge = static_cast<std::uint32_t>(i);
      const std::uint32_t from = source_vertex(mesh, edge);
      const std::uint32_t to = target_vertex(mesh, edge);
      const EdgeFinder::Matches opposite = finder.find(to, from);
      const bool manifold = from != to && opposite.count <= 1 && finder.find(from, to).count == 1;
      const std::uint32_t twin = opposite.count == 0 ? kBoundary : opposite.first;
      twins_[i] = manifold ? twin : kNonManifold;
    }
  });
}

}  // namespace frangia
