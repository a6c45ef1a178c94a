#include "frangia/mesh/half_edges.h"

#include <algorithm>

#include "frangia/core/error.h"
#include "frangia/core/parallel.h"

namespace frangia {
namespace {

constexpr std::size_t kChunk = 16'384;

}  // namespace

HalfEdges::HalfEdges(const Mesh& mesh) {
  require(mesh.triangles.size() < kManyFaces / 3,
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
    edges_[first_[from_of(mesh, e)]++] = e;
  for (std::size_t v = vertices; v > 0; --v)
    first_[v] = first_[v - 1];
  first_[0] = 0;
  parallel_chunks(edges, kChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto edge = static_cast<std::uint32_t>(i);
      const std::uint32_t from = from_of(mesh, edge);
      const std::uint32_t to = to_of(mesh, edge);
      std::uint32_t found = kBoundary;
      for (const std::uint32_t other : leaving(to)) {
        if (to_of(mesh, other) == from) found = found == kBoundary ? other : kManyFaces;
      }
      for (const std::uint32_t other : leaving(from)) {
        if (other != edge && to_of(mesh, other) == to) found = kManyFaces;
      }
      twins_[i] = from == to ? kManyFaces : found;
    }
  });
}

}  // namespace frangia
