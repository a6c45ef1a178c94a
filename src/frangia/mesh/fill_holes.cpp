#include "frangia/mesh/fill_holes.h"

#include <algorithm>
#include <array>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/geometry/boundary_loops.h"
#include "frangia/geometry/triangles_intersect.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/mesh/internal/hole_patch.h"
#include "frangia/mesh/internal/patch_intersections.h"

namespace frangia {
namespace {

using VertexLoop = std::vector<std::uint32_t>;

/// A boundary that visits a vertex twice is two boundaries.
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

bool are_adjacent(const Mesh& mesh, const HalfEdges& edges, std::uint32_t a, std::uint32_t b) {
  const auto outgoing = edges.outgoing(a);
  return std::any_of(outgoing.begin(), outgoing.end(), [&](std::uint32_t edge) {
    return target_vertex(mesh, edge) == b || opposite_vertex(mesh, edge) == b;
  });
}

/// Whether no edge of the patch but the boundary's own is one of the mesh already.
bool fits(const Mesh& mesh,
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

/// Ways to fill a hole, each tamer than the one before.
struct FillMethod {
  HoleFill kind;
  double curvature;  ///< of a smooth filling: the share of the surroundings'
  const char* name;
};
constexpr std::array<FillMethod, 4> kMethods{
    {{HoleFill::Smooth, 1.0, "smoothly"},
     {HoleFill::Smooth, 0.5, "with half of the curvature around it"},
     {HoleFill::Smooth, 0.0, "with a film of least area"},
     {HoleFill::Flat, 0.0, "flat"}}};
constexpr std::size_t kFlatMethod = 3;

struct Filling {
  VertexLoop loop;
  HolePatch patch;
  std::size_t method = 0;
  bool fallback = false;
};

/// Of large holes the shape is chosen on a coarse patch.
bool is_large(const VertexLoop& loop) {
  constexpr std::size_t kManyEdges = 1000;
  return loop.size() >= kManyEdges;
}

/// The hole's patch of this way; none when there is no good one.
HolePatch patch_by_method(const Mesh& mesh,
                          const HalfEdges& edges,
                          const VertexLoop& loop,
                          std::size_t method,
                          bool coarse) {
  const auto [kind, curvature, name] = kMethods.at(method);
  HolePatch patch =
      kind == HoleFill::Smooth
          ? smooth_patch(mesh, edges, loop, {.curvature = curvature, .coarse = coarse})
          : flat_patch(mesh, loop);
  const bool there = std::all_of(
      patch.positions_mm.begin(), patch.positions_mm.end(), [](const Eigen::Vector3f& position) {
        return position.allFinite();  // fairing a boundary that is far from flat can fail
      });
  if (there && !patch.triangles.empty() && fits(mesh, edges, loop, patch)) return patch;
  return {};
}

/// Gives a filling the patch of its way, or a flat one, or a fan.
void fill(const Mesh& mesh, const HalfEdges& edges, Filling& filling, const Run& run) {
  filling.patch = patch_by_method(mesh, edges, filling.loop, filling.method, false);
  if (!filling.patch.triangles.empty()) return;
  if (filling.method != kFlatMethod) {
    run.note(fmt::format("a hole of {} edges has no smooth filling and is closed flat",
                         filling.loop.size()));
    filling.method = kFlatMethod;
    filling.fallback = false;
    filling.patch = patch_by_method(mesh, edges, filling.loop, kFlatMethod, false);
    if (!filling.patch.triangles.empty()) return;
  }
  run.note(
      fmt::format("a hole of {} edges is closed by a fan about its middle", filling.loop.size()));
  filling.patch = fan_patch(mesh, filling.loop);
}

std::vector<PatchIntersections> intersections_of(const Mesh& mesh,
                                                 const std::vector<Filling>& fillings) {
  std::vector<HolePatch> patches;
  patches.reserve(fillings.size());
  for (const Filling& filling : fillings)
    patches.push_back(filling.patch);
  return patch_intersections(mesh, patches);
}

void report(const std::vector<Filling>& fillings,
            const std::vector<PatchIntersections>& intersections,
            const Run& run) {
  std::size_t crossing = 0;
  for (std::size_t i = 0; i < fillings.size(); ++i) {
    if (intersections[i].all() > 0) ++crossing;
    if (!fillings[i].fallback) continue;
    run.note(fmt::format("a hole of {} edges is filled {}: otherwise it would cross the surface",
                         fillings[i].loop.size(),
                         kMethods.at(fillings[i].method).name));
  }
  if (crossing > 0) {
    run.warn(
        fmt::format("what fills {} of {} holes crosses the surface or itself somewhere; "
                    "--remove-self-intersections mends that",
                    crossing,
                    fillings.size()));
  }
}

/// Whether another shape may help: at the jagged boundaries of large holes none does.
bool can_be_improved(const Filling& filling, const PatchIntersections& intersections) {
  return intersections.inside > 0 || (intersections.at_boundary > 0 && !is_large(filling.loop));
}

/// Fills what crosses itself or its surroundings in tamer ways, as long as that helps.
void reduce_intersections(const Mesh& mesh,
                          const HalfEdges& edges,
                          std::vector<Filling>& fillings,
                          const Run& run) {
  std::vector<PatchIntersections> intersections = intersections_of(mesh, fillings);
  for (std::size_t method = 1; method < kMethods.size(); ++method) {
    std::vector<std::size_t> which;
    std::vector<Filling> retried;
    for (std::size_t i = 0; i < fillings.size(); ++i) {
      if (!can_be_improved(fillings[i], intersections[i])) continue;
      const VertexLoop& loop = fillings[i].loop;
      HolePatch patch = patch_by_method(mesh, edges, loop, method, is_large(loop));
      if (patch.triangles.empty()) continue;
      which.push_back(i);
      retried.push_back({loop, std::move(patch), method, true});
    }
    if (which.empty()) continue;
    run.check();
    const std::vector<PatchIntersections> left = intersections_of(mesh, retried);
    for (std::size_t k = 0; k < which.size(); ++k) {
      if (left[k].all() >= intersections[which[k]].all()) continue;
      fillings[which[k]] = std::move(retried[k]);
      intersections[which[k]] = left[k];
    }
  }
  report(fillings, intersections, run);
}

/// Smooth fillings of all boundaries, as tame as they must be.
std::vector<Filling> smooth_fillings(const Mesh& mesh,
                                     const HalfEdges& edges,
                                     std::vector<VertexLoop> vertex_loops,
                                     const Run& run) {
  std::vector<Filling> fillings;
  const bool can_test = can_test_intersections();
  for (VertexLoop& loop : vertex_loops) {
    Filling filling{.loop = std::move(loop), .patch = {}};
    if (can_test && is_large(filling.loop)) {
      filling.patch = patch_by_method(mesh, edges, filling.loop, 0, true);
    } else {
      fill(mesh, edges, filling, run);
    }
    fillings.push_back(std::move(filling));
    run.report(0.5 * static_cast<double>(fillings.size()) /
               static_cast<double>(vertex_loops.size()));
  }
  if (!can_test) return fillings;
  reduce_intersections(mesh, edges, fillings, run);
  for (Filling& filling : fillings)
    if (is_large(filling.loop)) fill(mesh, edges, filling, run);
  return fillings;
}

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
  const HalfEdges edges(mesh);
  const std::vector<BoundaryLoop> loops = boundary_loops(mesh, edges);
  for (const std::size_t number : options.only) {
    require(number < loops.size(),
            "fill_holes: the mesh has no hole of this number; --list shows them");
  }
  const auto base = static_cast<std::uint32_t>(mesh.vertices_mm.size());
  std::vector<VertexLoop> vertex_loops;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    const bool named = options.only.empty() ||
                       std::find(options.only.begin(), options.only.end(), i) != options.only.end();
    if (!named || loops[i].size_mm > options.up_to_mm) continue;
    for (VertexLoop& loop : simple_loops(vertices_of(mesh, loops[i])))
      if (loop.size() >= 3) vertex_loops.push_back(std::move(loop));
  }
  if (vertex_loops.empty()) return mesh;
  std::vector<Filling> fillings;
  if (options.kind == HoleFill::Smooth) {
    fillings = smooth_fillings(mesh, edges, std::move(vertex_loops), run);
  } else {
    for (VertexLoop& loop : vertex_loops) {
      fillings.push_back({.loop = std::move(loop), .patch = {}, .method = kFlatMethod});
      fill(mesh, edges, fillings.back(), run);
    }
  }
  for (const Filling& filling : fillings)
    append(mesh, filling.patch, filling.loop, base);
  recompute_normals(mesh);
  return mesh;
}

}  // namespace frangia
