#include "frangia/mesh/fill_holes.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/mesh/boundary_loops.h"
#include "frangia/mesh/hole_patch.h"
#include "frangia/mesh/vertex_data.h"

namespace frangia {
namespace {

using Rim = std::vector<std::uint32_t>;

/// A rim that visits a vertex twice is two rims.
std::vector<Rim> simple_rims(const Rim& rim) {
  std::vector<Rim> rims;
  Rim way;
  std::unordered_map<std::uint32_t, std::size_t> place;
  for (const std::uint32_t vertex : rim) {
    const auto found = place.find(vertex);
    if (found != place.end()) {
      const auto begin = way.begin() + static_cast<std::ptrdiff_t>(found->second);
      rims.emplace_back(begin, way.end());
      for (auto i = begin + 1; i != way.end(); ++i)
        place.erase(*i);
      way.erase(begin + 1, way.end());
    } else {
      place.emplace(vertex, way.size());
      way.push_back(vertex);
    }
  }
  rims.push_back(std::move(way));
  return rims;
}

bool joined(const Mesh& mesh, const HalfEdges& edges, std::uint32_t a, std::uint32_t b) {
  for (const std::uint32_t edge : edges.leaving(a))
    if (to_of(mesh, edge) == b || across_of(mesh, edge) == b) return true;
  return false;
}

/// Whether no edge of the patch but the rim's own is one of the mesh already.
bool fits(const Mesh& mesh, const HalfEdges& edges, const Rim& rim, const HolePatch& patch) {
  std::unordered_map<std::uint32_t, std::size_t> place;
  for (std::size_t i = 0; i < rim.size(); ++i)
    place.emplace(rim[i], i);
  for (const Mesh::Triangle& triangle : patch.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto a = place.find(triangle[i]);
      const auto b = place.find(triangle[(i + 1) % 3]);
      if (a == place.end() || b == place.end()) continue;
      const bool own = (b->second + 1) % rim.size() == a->second;
      const bool turned = (a->second + 1) % rim.size() == b->second && rim.size() > 3;
      if (turned || (!own && joined(mesh, edges, a->first, b->first))) return false;
    }
  }
  return true;
}

HolePatch patch_of(
    const Mesh& mesh, const HalfEdges& edges, const Rim& rim, HoleFill kind, const Run& run) {
  const auto is_good = [&](const HolePatch& patch) {
    const bool there = std::all_of(
        patch.places_mm.begin(), patch.places_mm.end(), [](const Eigen::Vector3f& place) {
          return place.allFinite();  // fairing a rim that is far from flat can fail
        });
    return there && !patch.triangles.empty() && fits(mesh, edges, rim, patch);
  };
  if (kind == HoleFill::Smooth) {
    HolePatch smooth = smooth_patch(mesh, edges, rim);
    if (is_good(smooth)) return smooth;
    run.note(
        fmt::format("a hole of {} edges has no smooth filling and is closed flat", rim.size()));
  }
  HolePatch flat = flat_patch(mesh, rim);
  if (is_good(flat)) return flat;
  run.note(fmt::format("a hole of {} edges is closed by a fan about its middle", rim.size()));
  return fan_patch(mesh, rim);
}

void append(Mesh& mesh, const HolePatch& patch, const Rim& rim, std::uint32_t base) {
  const auto begin = static_cast<std::uint32_t>(mesh.vertices_mm.size());
  ensure_marks(mesh);
  for (const Eigen::Vector3f& place : patch.places_mm)
    invent_vertex(mesh, place, rim);
  for (Mesh::Triangle triangle : patch.triangles) {
    for (std::uint32_t& vertex : triangle)
      if (vertex >= base) vertex += begin - base;
    add_triangle(mesh, triangle, Mark::Invented);
  }
}

}  // namespace

Mesh fill_holes(Mesh mesh, const FillHolesOptions& options, const Run& run) {
  const HalfEdges edges(mesh);
  const std::vector<BoundaryLoop> loops = boundary_loops(mesh, edges);
  for (const std::size_t number : options.only)
    require(number < loops.size(),
            "fill_holes: the mesh has no hole of this number; --list shows them");
  const auto base = static_cast<std::uint32_t>(mesh.vertices_mm.size());
  std::vector<std::pair<Rim, HolePatch>> patches;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    const bool named = options.only.empty() ||
                       std::find(options.only.begin(), options.only.end(), i) != options.only.end();
    if (!named || loops[i].size_mm > options.up_to_mm) continue;
    for (Rim& rim : simple_rims(vertices_of(mesh, loops[i]))) {
      if (rim.size() < 3) continue;
      HolePatch patch = patch_of(mesh, edges, rim, options.kind, run);
      patches.emplace_back(std::move(rim), std::move(patch));
    }
    run.report((static_cast<double>(i) + 1.0) / static_cast<double>(loops.size()));
  }
  for (const auto& [rim, patch] : patches)
    append(mesh, patch, rim, base);
  if (!patches.empty()) renew_normals(mesh);
  return mesh;
}

}  // namespace frangia
