#include "frangia/mesh/fill_holes.h"

#include <algorithm>
#include <unordered_map>
#include <utility>
#include <vector>

#include "frangia/core/error.h"
#include "frangia/geometry/boundary_loops.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/mesh/internal/choose_patches.h"
#include "frangia/mesh/internal/with_manifold_edges.h"

namespace frangia {
namespace {

/// Splits a boundary that visits a vertex twice into simple loops.
std::vector<VertexLoop> simple_loops(const VertexLoop& loop) {
  std::vector<VertexLoop> vertex_loops;
  VertexLoop path;
  std::unordered_map<std::uint32_t, std::size_t> position;
  for (const std::uint32_t vertex : loop) {
    const auto found = position.find(vertex);
    if (found != position.end()) {
      const auto begin = path.begin() + static_cast<std::ptrdiff_t>(found->second);
      vertex_loops.emplace_back(begin, path.end());
      for (auto i = begin + 1; i != path.end(); ++i)
        position.erase(*i);
      path.erase(begin + 1, path.end());
    } else {
      position.emplace(vertex, path.size());
      path.push_back(vertex);
    }
  }
  vertex_loops.push_back(std::move(path));
  return vertex_loops;
}

/// Adds a patch to the mesh, which had `base` vertices when the patch was computed.
void append(Mesh& mesh, const HolePatch& patch, const VertexLoop& loop, std::uint32_t base) {
  const auto begin = static_cast<std::uint32_t>(mesh.vertices_mm.size());
  ensure_marks(mesh);
  for (const Eigen::Vector3f& position : patch.positions_mm)
    add_synthesized_vertex(mesh, position, loop);
  for (Mesh::Triangle triangle : patch.triangles) {
    for (std::uint32_t& vertex : triangle)
      if (vertex >= base) vertex += begin - base;
    add_triangle(mesh, triangle, Mark::Synthesized);
  }
}

}  // namespace

Mesh fill_holes(Mesh mesh, const FillHolesOptions& options, const Run& run) {
  run.check();
  if (options.only.empty()) mesh = with_manifold_edges(std::move(mesh), "hole filling", run);
  const HalfEdges edges(mesh);
  const std::vector<BoundaryLoop> loops = boundary_loops(mesh, edges);
  for (const std::size_t number : options.only) {
    require(number < loops.size(), "the mesh has no hole of this number; `list` shows the holes");
  }
  const auto base = static_cast<std::uint32_t>(mesh.vertices_mm.size());
  std::vector<VertexLoop> vertex_loops;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    const bool is_chosen =
        options.only.empty() ||
        std::find(options.only.begin(), options.only.end(), i) != options.only.end();
    if (!is_chosen || loops[i].size_mm > options.up_to_mm) continue;
    for (VertexLoop& loop : simple_loops(vertices_of(mesh, loops[i])))
      if (loop.size() >= 3) vertex_loops.push_back(std::move(loop));
  }
  if (vertex_loops.empty()) return mesh;
  const std::vector<HolePatch> patches = options.kind == HoleFill::Smooth
                                             ? choose_smooth_patches(mesh, edges, vertex_loops, run)
                                             : choose_flat_patches(mesh, edges, vertex_loops, run);
  for (std::size_t i = 0; i < patches.size(); ++i)
    append(mesh, patches[i], vertex_loops[i], base);
  recompute_normals(mesh);
  return mesh;
}

}  // namespace frangia
