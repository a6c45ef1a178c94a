#include "frangia/mesh/remove_self_intersections.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/mesh/boundary_loops.h"
#include "frangia/mesh/change_selection.h"
#include "frangia/mesh/connected_parts.h"
#include "frangia/mesh/fill_holes.h"
#include "frangia/mesh/half_edges.h"
#include "frangia/mesh/make_manifold.h"
#include "frangia/mesh/self_intersections.h"
#include "frangia/mesh/unite_bodies.h"
#include "frangia/mesh/vertex_data.h"

namespace frangia {
namespace {

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

Mesh part_of(const Mesh& mesh, const ConnectedParts& all, std::uint32_t part) {
  Selection keep(mesh.triangles.size());
  for (std::size_t t = 0; t < keep.size(); ++t)
    keep[t] = all.part_of[t] == part ? 1 : 0;
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

/// Two parts that cross each other, and of which neither was found to be no body.
std::optional<std::pair<std::uint32_t, std::uint32_t>> crossing_parts(
    const Pairs& pairs,
    const ConnectedParts& parts,
    const std::set<std::pair<std::uint32_t, std::uint32_t>>& refused) {
  for (const auto& [a, b] : pairs) {
    const auto both = std::minmax(parts.part_of[a], parts.part_of[b]);
    if (both.first != both.second && !refused.contains(both)) return both;
  }
  return std::nullopt;
}

/// The mesh with the bodies that cross each other united.
Mesh with_bodies_united(Mesh mesh, const Run& run) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> refused;
  for (;;) {
    const Pairs pairs = self_intersections(mesh, run);
    const ConnectedParts parts = connected_parts(mesh);
    const auto two = crossing_parts(pairs, parts, refused);
    if (!two) return mesh;
    const Mesh a = part_of(mesh, parts, two->first);
    const Mesh b = part_of(mesh, parts, two->second);
    std::optional<Mesh> united;
    if (volume_of(a) > 0.0 && volume_of(b) > 0.0) united = unite_bodies(a, b);
    if (!united) {
      refused.insert(*two);
      continue;
    }
    Selection others(mesh.triangles.size());
    for (std::size_t t = 0; t < others.size(); ++t)
      others[t] = parts.part_of[t] != two->first && parts.part_of[t] != two->second ? 1 : 0;
    keep_triangles(mesh, others);
    append_mesh(mesh, *united);
    refused.clear();  // the parts have other numbers now
    run.check();
  }
}

/// What a cut piece is: less than this share of what it was cut from is dropped.
constexpr double kCrumb = 0.1;

/// Adds what deleting would cut off: pieces that are small beside the largest of their part.
Selection with_crumbs(const Mesh& mesh, Selection going) {
  const ConnectedParts before = connected_parts(mesh);
  Mesh left = mesh;
  const Selection staying = invert_selection(going);
  keep_triangles(left, staying);
  const ConnectedParts after = connected_parts(left);
  std::vector<std::uint32_t> came_from(after.parts.size());
  std::vector<std::uint32_t> piece_of(mesh.triangles.size());
  std::size_t next = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (staying[t] == 0) continue;
    piece_of[t] = after.part_of[next++];
    came_from[piece_of[t]] = before.part_of[t];
  }
  std::vector<double> largest(before.parts.size());
  for (std::size_t p = 0; p < after.parts.size(); ++p)
    largest[came_from[p]] = std::max(largest[came_from[p]], after.parts[p].area_mm2);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (staying[t] == 0) continue;
    const std::uint32_t piece = piece_of[t];
    if (after.parts[piece].area_mm2 < kCrumb * largest[came_from[piece]]) going[t] = 1;
  }
  return going;
}

enum class At : std::uint8_t { Inside, Wound, Boundary };

/// For each vertex that is left after deleting whether something at it went, and whether it was on
/// a boundary before.
std::vector<At> places_after_deleting(const Mesh& mesh, const Selection& going) {
  std::vector<std::uint8_t> stays(mesh.vertices_mm.size());
  std::vector<At> at(mesh.vertices_mm.size(), At::Inside);
  for (std::size_t i = 0; i < going.size(); ++i) {
    for (const std::uint32_t vertex : mesh.triangles[i]) {
      if (going[i] != 0) at[vertex] = At::Wound;
      if (going[i] == 0) stays[vertex] = 1;
    }
  }
  const HalfEdges edges(mesh);
  for (std::uint32_t edge = 0; edge < edges.count(); ++edge) {
    if (edges.is_boundary(edge)) at[from_of(mesh, edge)] = at[to_of(mesh, edge)] = At::Boundary;
  }
  std::vector<At> left;
  for (std::size_t v = 0; v < stays.size(); ++v)
    if (stays[v] != 0) left.push_back(at[v]);
  return left;
}

/// Closes the loops that are wounds all along.
Mesh close_wounds(Mesh mesh, const std::vector<At>& at) {
  FillHolesOptions options;
  const std::vector<BoundaryLoop> loops = boundary_loops(mesh);
  for (std::size_t i = 0; i < loops.size(); ++i) {
    const auto vertices = vertices_of(mesh, loops[i]);
    const auto is = [&](At what) {
      return [&at, what](std::uint32_t v) { return v < at.size() && at[v] == what; };
    };
    if (std::any_of(vertices.begin(), vertices.end(), is(At::Wound)) &&
        std::none_of(vertices.begin(), vertices.end(), is(At::Boundary))) {
      options.only.push_back(i);
    }
  }
  return options.only.empty() ? mesh : fill_holes(std::move(mesh), options);
}

}  // namespace

Mesh remove_self_intersections(Mesh mesh, const Run& run) {
  constexpr int kRounds = 8;
  mesh = with_bodies_united(std::move(mesh), run);
  for (int round = 0; round < kRounds; ++round) {
    Selection crossing = select_self_intersections(mesh, run);
    if (count_of(crossing) == 0) return mesh;
    crossing = with_crumbs(mesh, grow_selection(mesh, std::move(crossing), round));
    const std::vector<At> at = places_after_deleting(mesh, crossing);
    mesh = close_wounds(make_manifold(delete_selected(std::move(mesh), crossing)), at);
    run.report((round + 1.0) / kRounds);
  }
  if (count_of(select_self_intersections(mesh, run)) > 0) {
    run.warn("some triangles cross still; remove them by hand and fill the holes they leave");
  }
  return mesh;
}

}  // namespace frangia
