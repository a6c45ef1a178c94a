#include "frangia/mesh/fill_holes.h"

#include <algorithm>
#include <array>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/mesh/boundary_loops.h"
#include "frangia/mesh/hole_patch.h"
#include "frangia/mesh/patch_crossings.h"
#include "frangia/mesh/triangles_cross.h"
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
  const auto leaving = edges.leaving(a);
  return std::any_of(leaving.begin(), leaving.end(), [&](std::uint32_t edge) {
    return to_of(mesh, edge) == b || across_of(mesh, edge) == b;
  });
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

/// Ways to fill a hole, each tamer than the one before.
struct Way {
  HoleFill kind;
  double curvature;  ///< of a smooth filling: the share of the surroundings'
  const char* name;
};
constexpr std::array<Way, 4> kWays{{{HoleFill::Smooth, 1.0, "smoothly"},
                                    {HoleFill::Smooth, 0.5, "with half of the curvature around it"},
                                    {HoleFill::Smooth, 0.0, "with a film of least area"},
                                    {HoleFill::Flat, 0.0, "flat"}}};
constexpr std::size_t kFlatWay = 3;

struct Filling {
  Rim rim;
  HolePatch patch;
  std::size_t way = 0;
  bool tamed = false;
};

/// Of large holes the shape is chosen on a coarse patch.
bool is_large(const Rim& rim) {
  constexpr std::size_t kManyEdges = 1000;
  return rim.size() >= kManyEdges;
}

/// The hole's patch of this way; none when there is no good one.
HolePatch patch_of_way(
    const Mesh& mesh, const HalfEdges& edges, const Rim& rim, std::size_t way, bool coarse) {
  const auto [kind, curvature, name] = kWays.at(way);
  HolePatch patch = kind == HoleFill::Smooth
                        ? smooth_patch(mesh, edges, rim, {.curvature = curvature, .coarse = coarse})
                        : flat_patch(mesh, rim);
  const bool there =
      std::all_of(patch.places_mm.begin(), patch.places_mm.end(), [](const Eigen::Vector3f& place) {
        return place.allFinite();  // fairing a rim that is far from flat can fail
      });
  if (there && !patch.triangles.empty() && fits(mesh, edges, rim, patch)) return patch;
  return {};
}

/// Gives a filling the patch of its way, or a flat one, or a fan.
void fill(const Mesh& mesh, const HalfEdges& edges, Filling& filling, const Run& run) {
  filling.patch = patch_of_way(mesh, edges, filling.rim, filling.way, false);
  if (!filling.patch.triangles.empty()) return;
  if (filling.way != kFlatWay) {
    run.note(fmt::format("a hole of {} edges has no smooth filling and is closed flat",
                         filling.rim.size()));
    filling.way = kFlatWay;
    filling.tamed = false;
    filling.patch = patch_of_way(mesh, edges, filling.rim, kFlatWay, false);
    if (!filling.patch.triangles.empty()) return;
  }
  run.note(
      fmt::format("a hole of {} edges is closed by a fan about its middle", filling.rim.size()));
  filling.patch = fan_patch(mesh, filling.rim);
}

std::vector<PatchCrossings> crossings_of(const Mesh& mesh, const std::vector<Filling>& fillings) {
  std::vector<HolePatch> patches;
  for (const Filling& filling : fillings)
    patches.push_back(filling.patch);
  return patch_crossings(mesh, patches);
}

void tell(const std::vector<Filling>& fillings,
          const std::vector<PatchCrossings>& crossings,
          const Run& run) {
  std::size_t crossing = 0;
  for (std::size_t i = 0; i < fillings.size(); ++i) {
    if (crossings[i].all() > 0) ++crossing;
    if (!fillings[i].tamed) continue;
    run.note(fmt::format("a hole of {} edges is filled {}: otherwise it would cross the surface",
                         fillings[i].rim.size(),
                         kWays.at(fillings[i].way).name));
  }
  if (crossing > 0) {
    run.warn(
        fmt::format("what fills {} of {} holes crosses the surface or itself somewhere; "
                    "--remove-self-intersections mends that",
                    crossing,
                    fillings.size()));
  }
}

/// Whether another shape may help: at the jagged rims of large holes none does.
bool is_worth_taming(const Filling& filling, const PatchCrossings& crossings) {
  return crossings.inside > 0 || (crossings.at_rim > 0 && !is_large(filling.rim));
}

/// Fills what crosses itself or its surroundings in tamer ways, as long as that helps.
void tame(const Mesh& mesh,
          const HalfEdges& edges,
          std::vector<Filling>& fillings,
          const Run& run) {
  std::vector<PatchCrossings> crossings = crossings_of(mesh, fillings);
  for (std::size_t way = 1; way < kWays.size(); ++way) {
    std::vector<std::size_t> which;
    std::vector<Filling> tamer;
    for (std::size_t i = 0; i < fillings.size(); ++i) {
      if (!is_worth_taming(fillings[i], crossings[i])) continue;
      const Rim& rim = fillings[i].rim;
      HolePatch patch = patch_of_way(mesh, edges, rim, way, is_large(rim));
      if (patch.triangles.empty()) continue;
      which.push_back(i);
      tamer.push_back({rim, std::move(patch), way, true});
    }
    if (which.empty()) continue;
    run.check();
    const std::vector<PatchCrossings> left = crossings_of(mesh, tamer);
    for (std::size_t k = 0; k < which.size(); ++k) {
      if (left[k].all() >= crossings[which[k]].all()) continue;
      fillings[which[k]] = std::move(tamer[k]);
      crossings[which[k]] = left[k];
    }
  }
  tell(fillings, crossings, run);
}

/// Smooth fillings of all rims, as tame as they must be.
std::vector<Filling> smooth_fillings(const Mesh& mesh,
                                     const HalfEdges& edges,
                                     std::vector<Rim> rims,
                                     const Run& run) {
  std::vector<Filling> fillings;
  const bool can_tell = can_tell_what_crosses();
  for (Rim& rim : rims) {
    Filling filling{.rim = std::move(rim), .patch = {}};
    if (can_tell && is_large(filling.rim)) {
      filling.patch = patch_of_way(mesh, edges, filling.rim, 0, true);
    } else {
      fill(mesh, edges, filling, run);
    }
    fillings.push_back(std::move(filling));
    run.report(0.5 * static_cast<double>(fillings.size()) / static_cast<double>(rims.size()));
  }
  if (!can_tell) return fillings;
  tame(mesh, edges, fillings, run);
  for (Filling& filling : fillings)
    if (is_large(filling.rim)) fill(mesh, edges, filling, run);
  return fillings;
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
  for (const std::size_t number : options.only) {
    require(number < loops.size(),
            "fill_holes: the mesh has no hole of this number; --list shows them");
  }
  const auto base = static_cast<std::uint32_t>(mesh.vertices_mm.size());
  std::vector<Rim> rims;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    const bool named = options.only.empty() ||
                       std::find(options.only.begin(), options.only.end(), i) != options.only.end();
    if (!named || loops[i].size_mm > options.up_to_mm) continue;
    for (Rim& rim : simple_rims(vertices_of(mesh, loops[i])))
      if (rim.size() >= 3) rims.push_back(std::move(rim));
  }
  if (rims.empty()) return mesh;
  std::vector<Filling> fillings;
  if (options.kind == HoleFill::Smooth) {
    fillings = smooth_fillings(mesh, edges, std::move(rims), run);
  } else {
    for (Rim& rim : rims) {
      fillings.push_back({.rim = std::move(rim), .patch = {}, .way = kFlatWay});
      fill(mesh, edges, fillings.back(), run);
    }
  }
  for (const Filling& filling : fillings)
    append(mesh, filling.patch, filling.rim, base);
  renew_normals(mesh);
  return mesh;
}

}  // namespace frangia
