#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/median.h"
#include "frangia/mesh/internal/are_adjacent.h"
#include "frangia/mesh/internal/fair_patch.h"
#include "frangia/mesh/internal/hole_patch.h"
#include "frangia/mesh/internal/minimum_area_triangulation.h"
#include "frangia/mesh/internal/patch_mesh.h"
#include "frangia/mesh/internal/refine_patch.h"

namespace frangia {
namespace {

using Eigen::Vector3d;
using VertexLoop = std::vector<std::uint32_t>;

Vector3d position_of(const Mesh& mesh, std::uint32_t vertex) {
  return mesh.vertices_mm[vertex].cast<double>();
}

PatchSurroundings surroundings_of(const Mesh& mesh,
                                  const HalfEdges& edges,
                                  const VertexLoop& loop) {
  PatchSurroundings around;
  std::unordered_map<std::uint32_t, std::uint32_t> number;
  for (std::size_t i = 0; i < loop.size(); ++i)
    number.emplace(loop[i], static_cast<std::uint32_t>(i));
  std::vector<std::uint32_t> triangles;
  for (const std::uint32_t vertex : loop) {
    for (const std::uint32_t edge : edges.outgoing(vertex))
      triangles.push_back(edge / 3);
  }
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  for (const std::uint32_t t : triangles) {
    Mesh::Triangle named{};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t vertex = mesh.triangles[t].at(i);
      const auto fresh = static_cast<std::uint32_t>(loop.size() + around.outer_mm.size());
      const auto [position, is_new] = number.emplace(vertex, fresh);
      if (is_new) around.outer_mm.push_back(position_of(mesh, vertex));
      named.at(i) = position->second;
    }
    around.triangles.push_back(named);
  }
  return around;
}

/// The normal of the surroundings at each boundary vertex, smoothed along the boundary.
std::vector<Vector3d> boundary_normals(const std::vector<Vector3d>& boundary_mm,
                                       const PatchSurroundings& around) {
  constexpr int kRounds = 10;
  const auto position = [&](std::uint32_t v) {
    return v < boundary_mm.size() ? boundary_mm[v] : around.outer_mm[v - boundary_mm.size()];
  };
  std::vector<Vector3d> normals(boundary_mm.size(), Vector3d::Zero());
  for (const auto& [a, b, c] : around.triangles) {
    const Vector3d cross = (position(b) - position(a)).cross(position(c) - position(a));
    for (const std::uint32_t v : {a, b, c})
      if (v < boundary_mm.size()) normals[v] += cross;
  }
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<Vector3d> from = normals;
    for (std::size_t i = 0; i < from.size(); ++i)
      normals[i] += from[(i + 1) % from.size()] + from[(i + from.size() - 1) % from.size()];
  }
  return normals;
}

/// The mean edge length at each boundary vertex, limited to [1/2, 2] of the median.
std::vector<PatchSpacing> spacing_of(const Mesh& mesh,
                                     const HalfEdges& edges,
                                     const VertexLoop& loop) {
  std::vector<PatchSpacing> spacing;
  std::vector<double> lengths;
  for (const std::uint32_t vertex : loop) {
    double sum = 0.0;
    for (const std::uint32_t edge : edges.outgoing(vertex)) {
      sum += (position_of(mesh, target_vertex(mesh, edge)) - position_of(mesh, vertex)).norm();
      sum += (position_of(mesh, opposite_vertex(mesh, edge)) - position_of(mesh, vertex)).norm();
    }
    const auto count = static_cast<double>(2 * edges.outgoing(vertex).size());
    spacing.push_back({sum / std::max(count, 1.0), 0.0});
    lengths.push_back(spacing.back().edge_mm);
  }
  const double usual_mm = median(std::move(lengths));
  for (PatchSpacing& one : spacing)
    one.edge_mm = std::clamp(one.edge_mm, 0.5 * usual_mm, 2.0 * usual_mm);
  return spacing;
}

/// Splits chords of the patch that the mesh has as an edge already.
void split_duplicate_edges(PatchMesh& patch, const PatchMesh::AreAdjacent& have_edge) {
  const std::uint32_t edges = patch.half_edges();
  for (std::uint32_t edge = 0; edge < edges; ++edge) {
    const std::uint32_t a = patch.from(edge);
    const std::uint32_t b = patch.to(edge);
    if (a >= patch.boundary_vertices() || b >= patch.boundary_vertices() ||
        patch.twin(edge) == PatchMesh::kBoundary)
      continue;
    if (have_edge(a, b)) patch.split_edge(edge, 0.5 * (patch.position(a) + patch.position(b)));
  }
}

HolePatch hole_patch_of(const PatchMesh& patch, const VertexLoop& loop, std::size_t mesh_vertices) {
  HolePatch result;
  for (std::uint32_t v = patch.boundary_vertices(); v < patch.count(); ++v) {
    result.positions_mm.emplace_back(patch.position(v).cast<float>());
  }
  const auto vertex_of = [&](std::uint32_t v) {
    return v < patch.boundary_vertices()
               ? loop[v]
               : static_cast<std::uint32_t>(mesh_vertices + v - patch.boundary_vertices());
  };
  for (std::uint32_t edge = 0; edge < patch.half_edges(); edge += 3) {
    result.triangles.push_back({vertex_of(patch.from(edge)),
                                vertex_of(patch.from(edge + 1)),
                                vertex_of(patch.from(edge + 2))});
  }
  return result;
}

}  // namespace

HolePatch smooth_patch(const Mesh& mesh,
                       const HalfEdges& edges,
                       const VertexLoop& boundary,
                       const SmoothPatchOptions& options,
                       const Run& run) {
  if (boundary.size() < 3) return {};
  VertexLoop loop(boundary.rbegin(), boundary.rend());  // the patch has the opposite direction
  const auto have_edge = [&](std::size_t a, std::size_t b) {
    return are_adjacent(mesh, edges, loop[a], loop[b]);
  };
  std::vector<Vector3d> positions;
  for (const std::uint32_t vertex : loop)
    positions.push_back(position_of(mesh, vertex));
  const PatchSurroundings around = surroundings_of(mesh, edges, loop);
  const auto triangles = minimum_area_triangulation(
      positions, {.normals = boundary_normals(positions, around), .is_forbidden = have_edge}, run);
  PatchMesh patch(std::move(positions), triangles, have_edge);
  split_duplicate_edges(patch, have_edge);
  patch.restore_delaunay();
  std::vector<PatchSpacing> spacing = spacing_of(mesh, edges, loop);
  while (spacing.size() < patch.count())
    spacing.push_back(spacing.front());
  PatchRefinement refinement(patch, std::move(spacing));
  if (!refinement.refine_coarsely(run) || !fair_patch(patch, around, options.curvature, run))
    return {};
  if (!options.coarse && !refinement.refine_finely(around, options.curvature, run)) return {};
  return hole_patch_of(patch, loop, mesh.vertices_mm.size());
}

}  // namespace frangia
