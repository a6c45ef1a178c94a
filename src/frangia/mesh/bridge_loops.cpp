#include "frangia/mesh/bridge_loops.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "frangia/core/error.h"
#include "frangia/geometry/boundary_loops.h"
#include "frangia/geometry/vertex_data.h"

namespace frangia {
namespace {

using VertexLoop = std::vector<std::uint32_t>;

float squared_distance(const Mesh& mesh, std::uint32_t a, std::uint32_t b) {
  return (mesh.vertices_mm[a] - mesh.vertices_mm[b]).squaredNorm();
}

/// Turns both boundaries so that they begin at their nearest corners.
void begin_together(const Mesh& mesh, VertexLoop& first, VertexLoop& second) {
  float nearest = std::numeric_limits<float>::infinity();
  std::ptrdiff_t begin_first = 0;
  std::ptrdiff_t begin_second = 0;
  for (std::ptrdiff_t i = 0; i < std::ssize(first); ++i) {
    for (std::ptrdiff_t k = 0; k < std::ssize(second); ++k) {
      const float way = squared_distance(
          mesh, first[static_cast<std::size_t>(i)], second[static_cast<std::size_t>(k)]);
      if (way >= nearest) continue;
      nearest = way;
      begin_first = i;
      begin_second = k;
    }
  }
  std::rotate(first.begin(), first.begin() + begin_first, first.end());
  std::rotate(second.begin(), second.begin() + begin_second, second.end());
}

}  // namespace

Mesh bridge_loops(Mesh mesh, std::size_t first_loop, std::size_t second_loop) {
  const std::vector<BoundaryLoop> loops = boundary_loops(mesh);
  require(first_loop < loops.size() && second_loop < loops.size(),
          "bridge: the mesh has no hole of this number; --list shows them");
  require(first_loop != second_loop, "bridge: name two different holes");
  VertexLoop first = vertices_of(mesh, loops[first_loop]);
  VertexLoop second = vertices_of(mesh, loops[second_loop]);
  std::reverse(second.begin(), second.end());  // the boundaries of a band run against each other
  begin_together(mesh, first, second);
  std::size_t i = 0;
  std::size_t k = 0;
  while (i < first.size() || k < second.size()) {
    const std::uint32_t a = first[i % first.size()];
    const std::uint32_t b = second[k % second.size()];
    const std::uint32_t next_a = first[(i + 1) % first.size()];
    const std::uint32_t next_b = second[(k + 1) % second.size()];
    const bool on_first = k == second.size() ||
                          (i < first.size() &&
                           squared_distance(mesh, next_a, b) <= squared_distance(mesh, a, next_b));
    if (on_first) {
      add_triangle(mesh, {next_a, a, b}, Mark::Synthesized);
      ++i;
    } else {
      add_triangle(mesh, {b, next_b, a}, Mark::Synthesized);
      ++k;
    }
  }
  recompute_normals(mesh);
  return mesh;
}

}  // namespace frangia
