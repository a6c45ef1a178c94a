#include "frangia/mesh/internal/smooth_patch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/parallel.h"
#include "frangia/core/statistics.h"
#include "frangia/geometry/aabb_tree.h"
#include "frangia/geometry/triangle_predicates.h"
#include "frangia/geometry/triangles_intersect.h"
#include "frangia/mesh/internal/are_adjacent.h"
#include "frangia/mesh/internal/fair_patch.h"
#include "frangia/mesh/internal/hole_patch.h"
#include "frangia/mesh/internal/patch_mesh.h"
#include "frangia/mesh/internal/refine_patch.h"
#include "frangia/mesh/internal/triangulate_hole.h"

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

namespace {

constexpr std::size_t kCandidatesPerChunk = 16'384;

/// The triangles of all patches.
class Patches {
 public:
  Patches(const Mesh& mesh, const std::vector<HolePatch>& patches) : mesh_(mesh) {
    const auto count = static_cast<std::uint32_t>(mesh.vertices_mm.size());
    for (std::uint32_t patch = 0; patch < patches.size(); ++patch) {
      const auto shift = static_cast<std::uint32_t>(positions_.size());
      for (Mesh::Triangle triangle : patches[patch].triangles) {
        for (std::uint32_t& vertex : triangle)
          if (vertex >= count) vertex += shift;
        triangles_.push_back(triangle);
        owner_.push_back(patch);
      }
      positions_.insert(
          positions_.end(), patches[patch].positions_mm.begin(), patches[patch].positions_mm.end());
    }
    find_boundaries();
  }

  /// The patches as triangles without shared vertices, for an AabbTree.
  [[nodiscard]] Mesh unconnected() const {
    Mesh all;
    for (const Mesh::Triangle& name : triangles_) {
      const auto first = static_cast<std::uint32_t>(all.vertices_mm.size());
      for (const std::uint32_t vertex : name)
        all.vertices_mm.push_back(position(vertex));
      all.triangles.push_back({first, first + 1, first + 2});
    }
    return all;
  }
  [[nodiscard]] IndexedTriangle corners(const Mesh::Triangle& triangle) const {
    return indexed_triangle(triangle, [&](std::uint32_t v) { return position(v).cast<double>(); });
  }
  [[nodiscard]] const Mesh::Triangle& triangle(std::uint32_t triangle) const {
    return triangles_[triangle];
  }
  [[nodiscard]] std::uint32_t owner(std::uint32_t triangle) const { return owner_[triangle]; }
  [[nodiscard]] bool at_boundary(std::uint32_t triangle) const {
    return at_boundary_[triangle] != 0;
  }

 private:
  /// Finds the triangles within five rings of the boundary vertices.
  void find_boundaries() {
    constexpr int kRings = 5;
    const std::size_t count = mesh_.vertices_mm.size();
    std::vector<std::uint8_t> reached(positions_.size());
    const auto is_reached = [&](std::uint32_t v) { return v < count || reached[v - count] != 0; };
    at_boundary_.assign(triangles_.size(), 0);
    for (int ring = 0; ring < kRings; ++ring) {
      for (std::size_t t = 0; t < triangles_.size(); ++t) {
        at_boundary_[t] =
            std::any_of(triangles_[t].begin(), triangles_[t].end(), is_reached) ? 1 : 0;
      }
      for (std::size_t t = 0; t < triangles_.size(); ++t) {
        for (const std::uint32_t vertex : triangles_[t])
          if (at_boundary_[t] != 0 && vertex >= count) reached[vertex - count] = 1;
      }
    }
  }
  [[nodiscard]] const Eigen::Vector3f& position(std::uint32_t vertex) const {
    const std::size_t count = mesh_.vertices_mm.size();
    return vertex < count ? mesh_.vertices_mm[vertex] : positions_[vertex - count];
  }

  const Mesh& mesh_;
  std::vector<Mesh::Triangle> triangles_;  ///< indices of mesh vertices, then of `positions_`
  std::vector<std::uint32_t> owner_;
  std::vector<std::uint8_t> at_boundary_;
  std::vector<Eigen::Vector3f> positions_;
};

bool intersect(const IndexedTriangle& a, const IndexedTriangle& b) {
  return !surely_disjoint(a, b) && triangles_intersect(a, b);
}

struct FoundPair {
  std::uint32_t patch;
  bool at_boundary;
};
using Found = std::vector<FoundPair>;

/// Adds the pairs that `find(begin, end, found)` appends, on all cores.
template <typename Find>
void add_found(std::size_t count,
               std::vector<PatchIntersections>& intersections,
               const Run& run,
               const Find& find) {
  std::vector<Found> found((count + kCandidatesPerChunk - 1) / kCandidatesPerChunk);
  parallel_chunks(count, kCandidatesPerChunk, [&](std::size_t begin, std::size_t end) {
    if (!run.stop.stop_requested()) find(begin, end, found[begin / kCandidatesPerChunk]);
  });
  run.check();
  for (const Found& pairs : found) {
    for (const FoundPair& pair : pairs) {
      PatchIntersections& of_patch = intersections[pair.patch];
      ++(pair.at_boundary ? of_patch.at_boundary : of_patch.inside);
    }
  }
}

}  // namespace

std::vector<PatchIntersections> patch_intersections(const Mesh& mesh,
                                                    const std::vector<HolePatch>& patches,
                                                    const Run& run) {
  std::vector<PatchIntersections> intersections(patches.size());
  const Patches all(mesh, patches);
  const AabbTree tree(all.unconnected());
  add_found(
      tree.leaves(), intersections, run, [&](std::size_t begin, std::size_t end, Found& found) {
        for (std::size_t leaf = begin; leaf < end; ++leaf) {
          tree.overlapping_pairs(leaf, [&](std::uint32_t a, std::uint32_t b) {
            if (!intersect(all.corners(all.triangle(a)), all.corners(all.triangle(b)))) return;
            const bool at_boundary = all.at_boundary(a) && all.at_boundary(b);
            found.push_back({all.owner(a), at_boundary});
            if (all.owner(b) != all.owner(a)) found.push_back({all.owner(b), at_boundary});
          });
        }
      });
  add_found(mesh.triangles.size(),
            intersections,
            run,
            [&](std::size_t begin, std::size_t end, Found& found) {
              for (std::size_t t = begin; t < end; ++t) {
                const auto box = AabbTree::box_of(mesh, static_cast<std::uint32_t>(t));
                tree.overlapping(box, [&](std::uint32_t a) {
                  if (intersect(all.corners(all.triangle(a)), all.corners(mesh.triangles[t])))
                    found.push_back({all.owner(a), all.at_boundary(a)});
                });
              }
            });
  return intersections;
}

}  // namespace frangia
