#include "frangia/mesh/internal/with_manifold_edges.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/geometry/connectivity.h"
#include "frangia/mesh/make_manifold.h"

namespace frangia {
namespace {

/// Edges of exactly two triangles whose half-edges have the same direction.
std::size_t count_inconsistent(const Mesh& mesh, const HalfEdges& edges) {
  using Ends = std::pair<std::uint32_t, std::uint32_t>;
  std::vector<std::pair<Ends, bool>> uses;  // and whether the half-edge begins at the lower vertex
  for (std::uint32_t edge = 0; edge < edges.count(); ++edge) {
    if (edges.has_twin(edge) || edges.is_boundary(edge)) continue;
    const std::uint32_t from = source_vertex(mesh, edge);
    const std::uint32_t to = target_vertex(mesh, edge);
    uses.emplace_back(std::minmax(from, to), from < to);
  }
  std::sort(uses.begin(), uses.end());
  std::size_t count = 0;
  for (std::size_t begin = 0; begin < uses.size();) {
    std::size_t end = begin;
    while (end < uses.size() && uses[end].first == uses[begin].first)
      ++end;
    if (end - begin == 2 && uses[begin].second == uses[begin + 1].second) ++count;
    begin = end;
  }
  return count;
}

}  // namespace

Mesh with_manifold_edges(Mesh mesh, std::string_view operation, const Run& run) {
  const HalfEdges edges(mesh);
  run.check();
  const std::size_t count = count_non_manifold_edges(mesh, edges);
  if (count == 0) return mesh;
  const std::size_t inconsistent = count_inconsistent(mesh, edges);
  if (inconsistent > 0) {
    throw Error(ErrorKind::Input,
                fmt::format("{} edges join two triangles of opposite orientation, which {} cannot "
                            "tell from a fold; use `orient` first, and `make_manifold` for those "
                            "that stay",
                            inconsistent,
                            operation));
  }
  run.warn(
      fmt::format("the mesh has {} non-manifold edge{}; {} split them first, as "
                  "`make_manifold` does",
                  count,
                  count == 1 ? "" : "s",
                  operation));
  return make_manifold(std::move(mesh), run);
}

}  // namespace frangia
