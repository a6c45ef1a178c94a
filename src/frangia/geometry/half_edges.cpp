#include "frangia/geometry/half_edges.h"

#include <algorithm>

#include "frangia/core/error.h"
#include "frangia/core/parallel.h"

namespace frangia {
namespace {

constexpr std::size_t kChunk = 16'384;

}  // namespace

HalfEdges::HalfEdges(const Mesh& mesh) {
  require(mesh.triangles.size() < kNonManifold / 3,
          "HalfEdges: more than 1.4 billion triangles; decimate the mesh first");
  const std::size_t vertices = mesh.vertices_mm.size();
  first_.assign(vertices + 1, 0);
  for (const Mesh::Triangle& triangle : mesh.triangles) {
    require(std::max({triangle[0], triangle[1], triangle[2]}) < vertices,
            "HalfEdges: a triangle refers to a vertex that is not there; repair the mesh first");
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
  parallel_chunks(edges, kChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto edge = static_cast<std::uint32_t>(i);
      const std::uint32_t from = source_vertex(mesh, edge);
      const std::uint32_t to = target_vertex(mesh, edge);
      std::uint32_t found = kBoundary;
      for (const std::uint32_t other : outgoing(to)) {
        if (target_vertex(mesh, other) == from) found = found == kBoundary ? other : kNonManifold;
      }
      for (const std::uint32_t other : outgoing(from)) {
        if (other != edge && target_vertex(mesh, other) == to) found = kNonManifold;
      }
      twins_[i] = from == to ? kNonManifold : found;
    }
  });
}

}  // namespace frangia
