#include "frangia/mesh/fill_holes.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/run.h"
#include "frangia/geometry/boundary.h"
#include "frangia/geometry/connectivity.h"
#include "frangia/geometry/mesh.h"
#include "frangia/geometry/triangles_intersect.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/mesh/internal/are_adjacent.h"
#include "frangia/mesh/internal/hole_patch.h"
#include "frangia/mesh/internal/smooth_patch.h"
#include "frangia/mesh/internal/with_manifold_edges.h"

namespace frangia {
namespace {

using VertexLoop = std::vector<std::uint32_t>;

/// Computes a smooth patch for each hole, or the best replacement as fill_holes describes.
///
/// @shape    one patch per loop; a loop visits no vertex twice
/// @errors   Error(Cancelled)
[[nodiscard]] std::vector<HolePatch> choose_smooth_patches(const Mesh& mesh,
                                                           const HalfEdges& edges,
                                                           const std::vector<VertexLoop>& loops,
                                                           const Run& run = {});

/// Computes a flat patch for each hole, or a fan.
///
/// @shape    one patch per loop; a loop visits no vertex twice
/// @errors   Error(Cancelled)
[[nodiscard]] std::vector<HolePatch> choose_flat_patches(const Mesh& mesh,
                                                         const HalfEdges& edges,
                                                         const std::vector<VertexLoop>& loops,
                                                         const Run& run = {});

/// Whether the mesh has no inner edge of the patch already.
bool keeps_manifold(const Mesh& mesh,
                    const HalfEdges& edges,
                    const VertexLoop& loop,
                    const HolePatch& patch) {
  std::unordered_map<std::uint32_t, std::size_t> position;
  for (std::size_t i = 0; i < loop.size(); ++i)
    position.emplace(loop[i], i);
  for (const Mesh::Triangle& triangle : patch.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto a = position.find(triangle[i]);
      const auto b = position.find(triangle[(i + 1) % 3]);
      if (a == position.end() || b == position.end()) continue;
      const bool own = (b->second + 1) % loop.size() == a->second;
      const bool turned = (a->second + 1) % loop.size() == b->second && loop.size() > 3;
      if (turned || (!own && are_adjacent(mesh, edges, a->first, b->first))) return false;
    }
  }
  return true;
}

/// Methods to fill a hole; each is less likely to intersect something than the one before.
struct FillMethod {
  HoleFill kind;
  double curvature;  ///< of a smooth patch: the share of the surrounding curvature
  const char* name;
};
constexpr std::array<FillMethod, 4> kMethods{
    {{HoleFill::Smooth, 1.0, "smoothly"},
     {HoleFill::Smooth, 0.5, "with half of the surrounding curvature"},
     {HoleFill::Smooth, 0.0, "by a minimal surface"},
     {HoleFill::Flat, 0.0, "flat"}}};
constexpr std::size_t kFlatMethod = 3;

/// A hole, its patch and the method that computed it.
struct Filling {
  VertexLoop loop;
  HolePatch patch;
  std::size_t method = 0;
  bool fallback = false;  ///< the method avoids intersections of the first one
};

/// Whether the method is chosen with coarse patches: a full patch takes seconds.
bool is_large(const VertexLoop& loop) {
  constexpr std::size_t kManyEdges = 1000;
  return loop.size() >= kManyEdges;
}

/// Computes the patch of a hole by one method; empty when it is not usable.
HolePatch patch_by_method(const Mesh& mesh,
                          const HalfEdges& edges,
                          const VertexLoop& loop,
                          std::size_t method,
                          bool coarse,
                          const Run& run) {
  const auto [kind, curvature, name] = kMethods.at(method);
  HolePatch patch =
      kind == HoleFill::Smooth
          ? smooth_patch(mesh, edges, loop, {.curvature = curvature, .coarse = coarse}, run)
          : flat_patch(mesh, loop);
  const bool is_finite = std::all_of(
      patch.positions_mm.begin(), patch.positions_mm.end(), [](const Eigen::Vector3f& position) {
        return position.allFinite();  // fairing can fail for a boundary far from a plane
      });
  if (is_finite && !patch.triangles.empty() && keeps_manifold(mesh, edges, loop, patch))
    return patch;
  return {};
}

/// Computes the patch of a filling by its method, else a flat patch, else a fan.
void fill(const Mesh& mesh, const HalfEdges& edges, Filling& filling, const Run& run) {
  filling.patch = patch_by_method(mesh, edges, filling.loop, filling.method, false, run);
  if (!filling.patch.triangles.empty()) return;
  if (filling.method != kFlatMethod) {
    run.note(fmt::format("a hole of {} edges has no smooth patch and is filled flat",
                         filling.loop.size()));
    filling.method = kFlatMethod;
    filling.fallback = false;
    filling.patch = patch_by_method(mesh, edges, filling.loop, kFlatMethod, false, run);
    if (!filling.patch.triangles.empty()) return;
  }
  run.note(fmt::format("a hole of {} edges is filled by a fan around its centroid",
                       filling.loop.size()));
  filling.patch = fan_patch(mesh, filling.loop);
}

std::vector<PatchIntersections> intersections_of(const Mesh& mesh,
                                                 const std::vector<Filling>& fillings,
                                                 const Run& run) {
  std::vector<HolePatch> patches;
  patches.reserve(fillings.size());
  for (const Filling& filling : fillings)
    patches.push_back(filling.patch);
  return patch_intersections(mesh, patches, run);
}

void report(const std::vector<Filling>& fillings,
            const std::vector<PatchIntersections>& intersections,
            const Run& run) {
  std::size_t intersecting = 0;
  for (std::size_t i = 0; i < fillings.size(); ++i) {
    if (intersections[i].all() > 0) ++intersecting;
    if (!fillings[i].fallback) continue;
    run.note(
        fmt::format("a hole of {} edges is filled {}: a smoother patch would intersect the surface",
                    fillings[i].loop.size(),
                    kMethods.at(fillings[i].method).name));
  }
  if (intersecting > 0) {
    run.warn(
        fmt::format("the patches of {} of {} holes intersect the surface or themselves; use "
                    "`remove_self_intersections`",
                    intersecting,
                    fillings.size()));
  }
}

/// Whether another method may help: none does at the jagged boundaries of large holes.
bool can_be_improved(const Filling& filling, const PatchIntersections& intersections) {
  return intersections.inside > 0 || (intersections.at_boundary > 0 && !is_large(filling.loop));
}

/// Replaces patches that intersect something by those of later methods with fewer intersections.
void reduce_intersections(const Mesh& mesh,
                          const HalfEdges& edges,
                          std::vector<Filling>& fillings,
                          const Run& run) {
  std::vector<PatchIntersections> intersections = intersections_of(mesh, fillings, run);
  for (std::size_t method = 1; method < kMethods.size(); ++method) {
    std::vector<std::size_t> retried_of;
    std::vector<Filling> retried;
    for (std::size_t i = 0; i < fillings.size(); ++i) {
      if (!can_be_improved(fillings[i], intersections[i])) continue;
      const VertexLoop& loop = fillings[i].loop;
      HolePatch patch = patch_by_method(mesh, edges, loop, method, is_large(loop), run);
      if (patch.triangles.empty()) continue;
      retried_of.push_back(i);
      retried.push_back({loop, std::move(patch), method, true});
    }
    if (retried_of.empty()) continue;
    const std::vector<PatchIntersections> left = intersections_of(mesh, retried, run);
    for (std::size_t k = 0; k < retried_of.size(); ++k) {
      if (left[k].all() >= intersections[retried_of[k]].all()) continue;
      fillings[retried_of[k]] = std::move(retried[k]);
      intersections[retried_of[k]] = left[k];
    }
  }
  report(fillings, intersections, run);
}

std::vector<HolePatch> patches_of(std::vector<Filling> fillings) {
  std::vector<HolePatch> patches;
  for (Filling& filling : fillings)
    patches.push_back(std::move(filling.patch));
  return patches;
}

std::vector<HolePatch> choose_flat_patches(const Mesh& mesh,
                                           const HalfEdges& edges,
                                           const std::vector<VertexLoop>& loops,
                                           const Run& run) {
  std::vector<Filling> fillings;
  for (const VertexLoop& loop : loops) {
    fillings.push_back({.loop = loop, .patch = {}, .method = kFlatMethod});
    fill(mesh, edges, fillings.back(), run);
    run.report(static_cast<double>(fillings.size()) / static_cast<double>(loops.size()));
  }
  return patches_of(std::move(fillings));
}

std::vector<HolePatch> choose_smooth_patches(const Mesh& mesh,
                                             const HalfEdges& edges,
                                             const std::vector<VertexLoop>& loops,
                                             const Run& run) {
  std::vector<Filling> fillings;
  const bool can_test = can_test_intersections();
  for (const VertexLoop& loop : loops) {
    Filling filling{.loop = loop, .patch = {}};
    if (can_test && is_large(loop)) {
      filling.patch = patch_by_method(mesh, edges, loop, 0, true, run);
    } else {
      fill(mesh, edges, filling, run);
    }
    fillings.push_back(std::move(filling));
    run.report(0.5 * static_cast<double>(fillings.size()) / static_cast<double>(loops.size()));
  }
  if (can_test) {
    reduce_intersections(mesh, edges, fillings, run);
    for (Filling& filling : fillings)
      if (is_large(filling.loop)) fill(mesh, edges, filling, run);
  }
  return patches_of(std::move(fillings));
}

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
