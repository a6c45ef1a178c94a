#include "frangia/mesh/bridge_loops.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "frangia/core/error.h"
#include "frangia/geometry/boundary.h"
#include "frangia/geometry/vertex_data.h"

namespace frangia {
namespace {

using VertexLoop = std::vector<std::uint32_t>;

float squared_distance(const Mesh& mesh, std::uint32_t a, std::uint32_t b) {
  return (mesh.vertices_mm[a] - mesh.vertices_mm[b]).squaredNorm();
}

/// Rotates both loops so that they begin at their closest pair of vertices.
void align_starts(const Mesh& mesh, VertexLoop& first, VertexLoop& second, const Run& run) {
  float nearest = std::numeric_limits<float>::infinity();
  std::ptrdiff_t begin_first = 0;
  std::ptrdiff_t begin_second = 0;
  for (std::ptrdiff_t i = 0; i < std::ssize(first); ++i) {
    run.check();
    for (std::ptrdiff_t k = 0; k < std::ssize(second); ++k) {
      const float distance = squared_distance(
          mesh, first[static_cast<std::size_t>(i)], second[static_cast<std::size_t>(k)]);
      if (distance >= nearest) continue;
      nearest = distance;
      begin_first = i;
      begin_second = k;
    }
  }
  std::rotate(first.begin(), first.begin() + begin_first, first.end());
  std::rotate(second.begin(), second.begin() + begin_second, second.end());
}

}  // namespace

Mesh bridge_loops(Mesh mesh, std::size_t first_loop, std::size_t second_loop, const Run& run) {
  const std::vector<BoundaryLoop> loops = boundary_loops(mesh);
  require(first_loop < loops.size() && second_loop < loops.size(),
          "the mesh has no hole of this number; `list` shows the holes");
  require(first_loop != second_loop,
          "a bridge joins two different holes; give two different numbers");
  VertexLoop first = vertices_of(mesh, loops[first_loop]);
  VertexLoop second = vertices_of(mesh, loops[second_loop]);
  std::reverse(second.begin(),
               second.end());  // the two boundaries of a band have opposite directions
  align_starts(mesh, first, second, run);
  std::size_t i = 0;
  std::size_t k = 0;
  while (i < first.size() || k < second.size()) {
    const std::uint32_t a = first[i % first.size()];
    const std::uint32_t b = second[k % second.size()];
    const std::uint32_t next_a = first[(i + 1) % first.size()];
    const std::uint32_t next_b = second[(k + 1) % second.size()];
    const bool advance_first =
        k == second.size() || (i < first.size() && squared_distance(mesh, next_a, b) <=
                                                       squared_distance(mesh, a, next_b));
    if (advance_first) {
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
