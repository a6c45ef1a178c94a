#include "frangia/mesh/remove_self_intersections.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/geometry/boundary_loops.h"
#include "frangia/geometry/change_selection.h"
#include "frangia/geometry/connected_components.h"
#include "frangia/geometry/half_edges.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/mesh/fill_holes.h"
#include "frangia/mesh/internal/unite_bodies.h"
#include "frangia/mesh/make_manifold.h"
#include "frangia/mesh/self_intersections.h"

namespace frangia {
namespace {

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

Mesh component_of(const Mesh& mesh, const ConnectedComponents& all, std::uint32_t part) {
  Selection keep(mesh.triangles.size());
  for (std::size_t t = 0; t < keep.size(); ++t)
    keep[t] = all.component_of[t] == part ? 1 : 0;
  Mesh one = mesh;
  keep_triangles(one, keep);
  return one;
}

double volume_of(const Mesh& mesh) {
  double volume = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    volume += mesh.vertices_mm[a].cast<double>().dot(
        mesh.vertices_mm[b].cast<double>().cross(mesh.vertices_mm[c].cast<double>()));
  }
  return volume / 6.0;
}

/// Two components that intersect each other and that were not refused as bodies.
std::optional<std::pair<std::uint32_t, std::uint32_t>> intersecting_components(
    const Pairs& pairs,
    const ConnectedComponents& parts,
    const std::set<std::pair<std::uint32_t, std::uint32_t>>& refused) {
  for (const auto& [a, b] : pairs) {
    const auto both = std::minmax(parts.component_of[a], parts.component_of[b]);
    if (both.first != both.second && !refused.contains(both)) return both;
  }
  return std::nullopt;
}

/// Unites closed components that intersect each other.
Mesh unite_intersecting_bodies(Mesh mesh, const Run& run) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> refused;
  for (;;) {
    const Pairs pairs = self_intersections(mesh, run);
    const ConnectedComponents parts = connected_components(mesh);
    const auto two = intersecting_components(pairs, parts, refused);
    if (!two) return mesh;
    const Mesh a = component_of(mesh, parts, two->first);
    const Mesh b = component_of(mesh, parts, two->second);
    std::optional<Mesh> united;
    if (volume_of(a) > 0.0 && volume_of(b) > 0.0) united = unite_bodies(a, b, run);
    if (!united) {
      refused.insert(*two);
      continue;
    }
    Selection others(mesh.triangles.size());
    for (std::size_t t = 0; t < others.size(); ++t)
      others[t] =
          parts.component_of[t] != two->first && parts.component_of[t] != two->second ? 1 : 0;
    keep_triangles(mesh, others);
    append_mesh(mesh, *united);
    refused.clear();  // the components have new numbers
    run.check();
  }
}

/// A piece that deleting cuts off is removed below this share of the largest piece's area.
constexpr double kFragment = 0.1;

/// Adds small pieces that deleting would cut off to the removed triangles.
Selection with_fragments(const Mesh& mesh, Selection removed) {
  const ConnectedComponents before = connected_components(mesh);
  Mesh left = mesh;
  const Selection kept = invert_selection(removed);
  keep_triangles(left, kept);
  const ConnectedComponents after = connected_components(left);
  std::vector<std::uint32_t> component_before(after.components.size());
  std::vector<std::uint32_t> piece_of(mesh.triangles.size());
  std::size_t next = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (kept[t] == 0) continue;
    piece_of[t] = after.component_of[next++];
    component_before[piece_of[t]] = before.component_of[t];
  }
  std::vector<double> largest(before.components.size());
  for (std::size_t p = 0; p < after.components.size(); ++p)
    largest[component_before[p]] =
        std::max(largest[component_before[p]], after.components[p].area_mm2);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (kept[t] == 0) continue;
    const std::uint32_t piece = piece_of[t];
    if (after.components[piece].area_mm2 < kFragment * largest[component_before[piece]])
      removed[t] = 1;
  }
  return removed;
}

enum class VertexOrigin : std::uint8_t { Inside, NewBoundary, OldBoundary };

/// Classifies the vertices that remain after deleting: those whose triangles were removed, and
/// those that were on a boundary before.
std::vector<VertexOrigin> origins_after_deleting(const Mesh& mesh, const Selection& removed) {
  std::vector<std::uint8_t> remains(mesh.vertices_mm.size());
  std::vector<VertexOrigin> at(mesh.vertices_mm.size(), VertexOrigin::Inside);
  for (std::size_t i = 0; i < removed.size(); ++i) {
    for (const std::uint32_t vertex : mesh.triangles[i]) {
      if (removed[i] != 0) at[vertex] = VertexOrigin::NewBoundary;
      if (removed[i] == 0) remains[vertex] = 1;
    }
  }
  const HalfEdges edges(mesh);
  for (std::uint32_t edge = 0; edge < edges.count(); ++edge) {
    if (edges.is_boundary(edge))
      at[source_vertex(mesh, edge)] = at[target_vertex(mesh, edge)] = VertexOrigin::OldBoundary;
  }
  std::vector<VertexOrigin> left;
  for (std::size_t v = 0; v < remains.size(); ++v)
    if (remains[v] != 0) left.push_back(at[v]);
  return left;
}

/// Fills the holes whose boundary is new and nowhere part of an old one.
Mesh close_new_boundaries(Mesh mesh, const std::vector<VertexOrigin>& at, const Run& run) {
  FillHolesOptions options;
  const std::vector<BoundaryLoop> loops = boundary_loops(mesh);
  for (std::size_t i = 0; i < loops.size(); ++i) {
    const auto vertices = vertices_of(mesh, loops[i]);
    const auto is = [&](VertexOrigin what) {
      return [&at, what](std::uint32_t v) { return v < at.size() && at[v] == what; };
    };
    if (std::any_of(vertices.begin(), vertices.end(), is(VertexOrigin::NewBoundary)) &&
        std::none_of(vertices.begin(), vertices.end(), is(VertexOrigin::OldBoundary))) {
      options.only.push_back(i);
    }
  }
  return options.only.empty() ? mesh : fill_holes(std::move(mesh), options, run);
}

}  // namespace

Mesh remove_self_intersections(Mesh mesh, const Run& run) {
  constexpr int kRounds = 8;  // each removes one more ring of triangles
  mesh = unite_intersecting_bodies(std::move(mesh), run);
  for (int round = 0; round < kRounds; ++round) {
    Selection intersecting = select_self_intersections(mesh, run);
    if (count_selected(intersecting) == 0) return mesh;
    intersecting = with_fragments(mesh, grow_selection(mesh, std::move(intersecting), round));
    const std::vector<VertexOrigin> at = origins_after_deleting(mesh, intersecting);
    mesh = make_manifold(delete_selected(std::move(mesh), intersecting), run);
    mesh = close_new_boundaries(std::move(mesh), at, run);
    run.report((round + 1.0) / kRounds);
  }
  if (count_selected(select_self_intersections(mesh, run)) > 0) {
    run.warn(
        "some triangles still intersect; select them with `select_self_intersections`, delete them "
        "and fill the holes");
  }
  return mesh;
}

}  // namespace frangia
