#include "frangia/geometry/components.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "frangia/core/disjoint_sets.h"
#include "frangia/core/error.h"
#include "frangia/geometry/connectivity.h"
#include "frangia/geometry/vertex_data.h"

namespace frangia {
namespace {

/// Returns the components by area, the largest first; of equal ones the earlier.
std::vector<std::size_t> by_area(const std::vector<MeshComponent>& components) {
  std::vector<std::size_t> order(components.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return components[a].area_mm2 > components[b].area_mm2;
  });
  return order;
}

Mesh keep_components(Mesh mesh,
                     const ConnectedComponents& parts,
                     const std::vector<std::uint8_t>& keep) {
  Selection kept(mesh.triangles.size());
  for (std::size_t i = 0; i < kept.size(); ++i)
    kept[i] = keep[parts.component_of[i]];
  if (count_selected(kept) < kept.size()) keep_triangles(mesh, kept);
  return mesh;
}

}  // namespace

ConnectedComponents connected_components(const Mesh& mesh) {
  constexpr std::uint32_t kUnnumbered = 0xFFFFFFFF;
  DisjointSets sets(mesh.vertices_mm.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    sets.join(a, b);
    sets.join(a, c);
  }
  ConnectedComponents found;
  found.component_of.resize(mesh.triangles.size());
  std::vector<std::uint32_t> number(mesh.vertices_mm.size(), kUnnumbered);
  std::vector<Eigen::AlignedBox3f> boxes;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& [a, b, c] = mesh.triangles[i];
    std::uint32_t& part = number[sets.find(a)];
    if (part == kUnnumbered) {
      part = static_cast<std::uint32_t>(found.components.size());
      found.components.emplace_back();
      boxes.emplace_back();
    }
    found.component_of[i] = part;
    MeshComponent& known = found.components[part];
    ++known.triangles;
    const Eigen::Vector3f& p = mesh.vertices_mm[a];
    const Eigen::Vector3f cross = (mesh.vertices_mm[b] - p).cross(mesh.vertices_mm[c] - p);
    known.area_mm2 += 0.5 * static_cast<double>(cross.norm());
    boxes[part].extend(p);
    boxes[part].extend(mesh.vertices_mm[b]);
    boxes[part].extend(mesh.vertices_mm[c]);
  }
  for (std::size_t part = 0; part < boxes.size(); ++part)
    found.components[part].size_mm = static_cast<double>(boxes[part].diagonal().norm());
  return found;
}

Selection select_component(const Mesh& mesh, std::size_t triangle) {
  require(triangle < mesh.triangles.size(), "select_component: the mesh has no such triangle");
  const ConnectedComponents parts = connected_components(mesh);
  Selection selection(mesh.triangles.size());
  for (std::size_t i = 0; i < selection.size(); ++i)
    selection[i] = parts.component_of[i] == parts.component_of[triangle] ? 1 : 0;
  return selection;
}

Mesh keep_largest_components(Mesh mesh, std::size_t count) {
  require(count > 0, "keep_largest_components: at least one component must be kept");
  const ConnectedComponents parts = connected_components(mesh);
  std::vector<std::size_t> order = by_area(parts.components);
  order.resize(std::min(order.size(), count));
  std::vector<std::uint8_t> keep(parts.components.size());
  for (const std::size_t part : order)
    keep[part] = 1;
  return keep_components(std::move(mesh), parts, keep);
}

Mesh remove_islands(Mesh mesh, double up_to_mm, const Run& run) {
  if (mesh.empty()) return mesh;
  const ConnectedComponents parts = connected_components(mesh);
  std::vector<std::uint8_t> keep(parts.components.size());
  for (std::size_t part = 0; part < keep.size(); ++part)
    keep[part] = parts.components[part].size_mm > up_to_mm ? 1 : 0;
  const std::size_t largest = by_area(parts.components).front();
  if (keep[largest] == 0) {
    run.warn(
        fmt::format("islands of up to {:.4g} mm are all components; the one of the largest area, "
                    "of {:.4g} mm, stays: choose a smaller size",
                    up_to_mm,
                    parts.components[largest].size_mm));
  }
  keep[largest] = 1;
  const std::size_t before = mesh.triangles.size();
  mesh = keep_components(std::move(mesh), parts, keep);
  const auto removed = std::count(keep.begin(), keep.end(), 0);
  if (removed > 0) {
    run.note(fmt::format("{} of {} components removed, {} triangles in total",
                         removed,
                         keep.size(),
                         before - mesh.triangles.size()));
  }
  return mesh;
}

namespace {

/// The half-edges without a single twin, sorted so that those of one edge follow each other.
class OddEdges {
 public:
  OddEdges(const Mesh& mesh, const HalfEdges& edges) {
    for (std::uint32_t edge = 0; edge < edges.count(); ++edge) {
      if (edges.has_twin(edge) || edges.is_boundary(edge)) continue;
      const auto ends = std::minmax({source_vertex(mesh, edge), target_vertex(mesh, edge)});
      if (ends.first != ends.second) sides_.push_back({ends.first, ends.second, edge});
    }
    std::sort(sides_.begin(), sides_.end());
  }

  /// Calls `work(sides)` with the half-edges of each edge, in ascending order.
  template <typename Work>
  void each(const Work& work) const {
    std::vector<std::uint32_t> at_edge;
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      at_edge.push_back(std::get<2>(sides_[i]));
      const bool is_last = i + 1 == sides_.size() ||
                           std::get<0>(sides_[i + 1]) != std::get<0>(sides_[i]) ||
                           std::get<1>(sides_[i + 1]) != std::get<1>(sides_[i]);
      if (!is_last) continue;
      work(std::as_const(at_edge));
      at_edge.clear();
    }
  }

 private:
  /// The lower and the higher vertex, and the half-edge.
  std::vector<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>> sides_;
};

/// What is connected over edges of two triangles, by triangle.
DisjointSets shells_of(const Mesh& mesh, const HalfEdges& edges, const OddEdges& odd) {
  DisjointSets shells(mesh.triangles.size());
  for (std::uint32_t edge = 0; edge < edges.count(); ++edge)
    if (edges.has_twin(edge)) shells.join(edge / 3, edges.twin(edge) / 3);
  odd.each([&](std::span<const std::uint32_t> sides) {
    if (sides.size() == 2) shells.join(sides[0] / 3, sides[1] / 3);
  });
  return shells;
}

/// Joins the corners at both ends of two sides of one edge. A corner is the half-edge that begins
/// there.
void join_ends(const Mesh& mesh, std::uint32_t a, std::uint32_t b, DisjointSets& corners) {
  const bool opposite = source_vertex(mesh, a) != source_vertex(mesh, b);
  corners.join(a, opposite ? HalfEdges::next(b) : b);
  corners.join(HalfEdges::next(a), opposite ? b : HalfEdges::next(b));
}

/// Joins the sides of an edge of several triangles in pairs; those without a partner stay together.
void join_sides(const Mesh& mesh,
                std::span<const std::uint32_t> sides,
                bool inside_out,
                DisjointSets& shells,
                DisjointSets& corners) {
  const std::uint32_t first = source_vertex(mesh, sides[0]);
  const std::uint32_t second = target_vertex(mesh, sides[0]);
  std::vector<EdgeSide> at_edge;
  at_edge.reserve(sides.size());
  for (const std::uint32_t side : sides)
    at_edge.push_back({mesh.vertices_mm[opposite_vertex(mesh, side)].cast<double>(),
                       (source_vertex(mesh, side) == first) != inside_out,
                       shells.find(side / 3)});
  const std::vector<std::size_t> partner = pair_sides(
      mesh.vertices_mm[first].cast<double>(), mesh.vertices_mm[second].cast<double>(), at_edge);
  std::size_t alone = kNoPartner;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (partner[i] == kNoPartner && alone == kNoPartner) alone = i;
    join_ends(mesh, sides[i], sides[partner[i] == kNoPartner ? alone : partner[i]], corners);
  }
}

/// Gives each set of corners at a vertex but the first a copy of the vertex.
void split_vertices(Mesh& mesh, DisjointSets& corners) {
  constexpr std::uint32_t kNotYet = 0xFFFFFFFF;
  std::vector<std::uint32_t> owner(mesh.vertices_mm.size(),
                                   kNotYet);  // the set that keeps a vertex
  std::vector<std::uint32_t> added(3 * mesh.triangles.size(), kNotYet);
  std::uint32_t corner = 0;
  for (Mesh::Triangle& triangle : mesh.triangles) {
    for (std::uint32_t& vertex : triangle) {
      const std::uint32_t set = corners.find(corner++);
      if (owner[vertex] == kNotYet) owner[vertex] = set;
      if (owner[vertex] == set) continue;
      if (added[set] == kNotYet) added[set] = copy_vertex(mesh, vertex);
      vertex = added[set];
    }
  }
}

}  // namespace

Mesh separate_shells(Mesh mesh) {
  const HalfEdges edges(mesh);
  const OddEdges odd(mesh, edges);
  DisjointSets corners(edges.count());
  for (std::uint32_t edge = 0; edge < edges.count(); ++edge)
    if (edges.has_twin(edge)) corners.join(edge, HalfEdges::next(edges.twin(edge)));
  DisjointSets shells = shells_of(mesh, edges, odd);
  const bool inside_out = is_inside_out(mesh);
  odd.each([&](std::span<const std::uint32_t> sides) {
    if (sides.size() == 2)
      join_ends(mesh, sides[0], sides[1], corners);
    else
      join_sides(mesh, sides, inside_out, shells, corners);
  });
  split_vertices(mesh, corners);
  return mesh;
}

}  // namespace frangia
