#include "frangia/mesh/make_manifold.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/disjoint_sets.h"
#include "frangia/geometry/clean_mesh.h"
#include "frangia/geometry/components.h"
#include "frangia/geometry/connectivity.h"
#include "frangia/geometry/selection.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/mesh/internal/steps_per_check.h"

namespace frangia {
namespace {

using Triangle = Mesh::Triangle;

bool is_valid(const Mesh& mesh, const Triangle& t) {
  if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return false;
  return std::all_of(t.begin(), t.end(), [&](std::uint32_t v) {
    return v < mesh.vertices_mm.size() && mesh.vertices_mm[v].allFinite();
  });
}

Triangle sorted(Triangle t) {
  std::sort(t.begin(), t.end());
  return t;
}

/// Whether two triangles have the same corners in the same sense.
bool is_same(const Triangle& a, const Triangle& b) {
  return a == b || a == Triangle{b[1], b[2], b[0]} || a == Triangle{b[2], b[0], b[1]};
}

/// Removes invalid triangles and all but the first of those with the same corners in the same
/// sense.
void remove_invalid(Mesh& mesh, const Run& run) {
  Selection keep(mesh.triangles.size());
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    keep[i] = is_valid(mesh, mesh.triangles[i]) ? 1 : 0;
    if (keep[i] != 0) order.push_back(i);
  }
  // Only triangles with the same smallest corner are compared: those are few.
  std::vector<std::uint32_t> first(mesh.vertices_mm.size() + 1, 0);
  const auto least = [&](std::uint32_t i) {
    const Triangle& t = mesh.triangles[i];
    return std::min({t[0], t[1], t[2]});
  };
  for (const std::uint32_t i : order)
    ++first[least(i) + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<std::uint32_t> sorted_by(order.size());
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  for (const std::uint32_t i : order)
    sorted_by[next[least(i)]++] = i;
  for (std::size_t v = 0; v + 1 < first.size(); ++v) {
    if (v % kStepsPerCheck == 0) run.check();
    for (std::uint32_t a = first[v]; a < first[v + 1]; ++a) {
      for (std::uint32_t b = a + 1; b < first[v + 1]; ++b) {
        if (is_same(mesh.triangles[sorted_by[a]], mesh.triangles[sorted_by[b]]))
          keep[sorted_by[b]] = 0;
      }
    }
  }
  keep_triangles(mesh, keep);
}

Eigen::Vector3d normal_of(const Mesh& mesh, std::uint32_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const Eigen::Vector3d p = mesh.vertices_mm[a].cast<double>();
  return (mesh.vertices_mm[b].cast<double>() - p)
      .cross(mesh.vertices_mm[c].cast<double>() - p)
      .stableNormalized();
}

/// Two triangles at a non-manifold edge, by their half-edges of opposite direction.
struct TrianglePair {
  double cosine;  ///< of the angle between the normals
  std::uint32_t out;
  std::uint32_t back;
};

/// Pairs the half-edges of a non-manifold edge as they enclose material, where that leaves none
/// over: bodies that touch stay apart.
bool pair_bodies(const Mesh& mesh,
                 const HalfEdges& edges,
                 std::uint32_t edge,
                 bool inside_out,
                 DisjointSets& shells,
                 DisjointSets& corners) {
  const std::uint32_t from = source_vertex(mesh, edge);
  const std::uint32_t to = target_vertex(mesh, edge);
  std::vector<std::uint32_t> half_edges;
  for (const std::uint32_t out : edges.outgoing(from))
    if (target_vertex(mesh, out) == to) half_edges.push_back(out);
  for (const std::uint32_t back : edges.outgoing(to))
    if (target_vertex(mesh, back) == from) half_edges.push_back(back);
  std::vector<EdgeSide> sides;
  for (const std::uint32_t one : half_edges)
    sides.push_back({mesh.vertices_mm[opposite_vertex(mesh, one)].cast<double>(),
                     (source_vertex(mesh, one) == from) != inside_out,
                     shells.find(one / 3)});
  const std::vector<std::size_t> partner =
      pair_sides(mesh.vertices_mm[from].cast<double>(), mesh.vertices_mm[to].cast<double>(), sides);
  for (std::size_t i = 0; i < sides.size(); ++i)
    if (partner[i] == kNoPartner || sides[i].upward == sides[partner[i]].upward) return false;
  for (std::size_t i = 0; i < sides.size(); ++i)
    corners.join(half_edges[i], HalfEdges::next(half_edges[partner[i]]));
  return true;
}

/// Pairs the half-edges of a non-manifold edge, the pair with the smallest dihedral angle first.
void pair_triangles(const Mesh& mesh,
                    const HalfEdges& edges,
                    std::uint32_t edge,
                    DisjointSets& corners) {
  const std::uint32_t from = source_vertex(mesh, edge);
  const std::uint32_t to = target_vertex(mesh, edge);
  std::vector<TrianglePair> pairs;
  for (const std::uint32_t out : edges.outgoing(from)) {
    if (target_vertex(mesh, out) != to) continue;
    for (const std::uint32_t back : edges.outgoing(to)) {
      if (target_vertex(mesh, back) != from) continue;
      pairs.push_back({normal_of(mesh, out / 3).dot(normal_of(mesh, back / 3)), out, back});
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(), [](const TrianglePair& a, const TrianglePair& b) {
    return a.cosine > b.cosine;
  });
  std::vector<std::uint32_t> taken;
  const auto is_taken = [&](std::uint32_t e) {
    return std::find(taken.begin(), taken.end(), e) != taken.end();
  };
  for (const TrianglePair& pair : pairs) {
    if (is_taken(pair.out) || is_taken(pair.back)) continue;
    taken.push_back(pair.out);
    taken.push_back(pair.back);
    corners.join(pair.out, HalfEdges::next(pair.back));
    corners.join(HalfEdges::next(pair.out), pair.back);
  }
}

/// Splits non-manifold edges and vertices with several fans: each fan gets its own vertex. Returns
/// the vertex that each one was.
std::vector<std::uint32_t> split_fans(Mesh& mesh, const Run& run) {
  const HalfEdges edges(mesh);
  const bool inside_out = is_inside_out(mesh);
  DisjointSets corners(edges.count());
  DisjointSets shells(mesh.triangles.size());
  for (std::uint32_t edge = 0; edge < edges.count(); ++edge)
    if (edges.has_twin(edge)) shells.join(edge / 3, edges.twin(edge) / 3);
  for (std::uint32_t edge = 0; edge < edges.count(); ++edge) {
    if (edge % kStepsPerCheck == 0) run.check();
    if (edges.has_twin(edge)) {
      corners.join(edge, HalfEdges::next(edges.twin(edge)));
    } else if (!edges.is_boundary(edge)) {
      // The lowest half-edge of the edge pairs all of them.
      const auto others = edges.outgoing(source_vertex(mesh, edge));
      const bool lowest = std::all_of(others.begin(), others.end(), [&](std::uint32_t e) {
        return e >= edge || target_vertex(mesh, e) != target_vertex(mesh, edge);
      });
      if (lowest && source_vertex(mesh, edge) < target_vertex(mesh, edge) &&
          !pair_bodies(mesh, edges, edge, inside_out, shells, corners))
        pair_triangles(mesh, edges, edge, corners);
    }
  }
  constexpr std::uint32_t kNone = 0xFFFFFFFF;
  std::vector<std::uint32_t> owner(mesh.vertices_mm.size(), kNone);  // the fan that keeps a vertex
  std::vector<std::uint32_t> added(edges.count(), kNone);
  std::vector<Triangle> new_index = mesh.triangles;
  std::vector<std::uint32_t> was(mesh.vertices_mm.size());
  std::iota(was.begin(), was.end(), 0U);
  for (std::uint32_t corner = 0; corner < edges.count(); ++corner) {
    const std::uint32_t fan = corners.find(corner);
    const std::uint32_t vertex = source_vertex(mesh, corner);
    if (owner[vertex] == kNone) owner[vertex] = fan;
    if (owner[vertex] == fan) continue;
    if (added[fan] == kNone) {
      added[fan] = copy_vertex(mesh, vertex);
      was.push_back(vertex);
    }
    new_index[corner / 3][corner % 3] = added[fan];
  }
  mesh.triangles = std::move(new_index);
  return was;
}

/// Removes the backs of triangles that are there in both senses, except where they are the face in
/// which two bodies touch. A back is the later one of a pair, on the same shell or on one that has
/// nothing but backs. Returns whether it removed any.
bool remove_backs(Mesh& mesh, const std::vector<std::uint32_t>& was, const Run& run) {
  std::vector<std::pair<Triangle, std::uint32_t>> by_places;
  by_places.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles)
    by_places.emplace_back(sorted({was[a], was[b], was[c]}),
                           static_cast<std::uint32_t>(by_places.size()));
  std::sort(by_places.begin(), by_places.end());
  run.check();
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::size_t i = 1; i < by_places.size(); ++i)
    if (by_places[i - 1].first == by_places[i].first)
      pairs.emplace_back(by_places[i - 1].second, by_places[i].second);
  if (pairs.empty()) return false;
  const ConnectedComponents found = connected_components(mesh);
  std::vector<std::size_t> backs(found.components.size());
  for (const auto& [front, back] : pairs)
    ++backs[found.component_of[back]];
  Selection keep(mesh.triangles.size(), 1);
  bool any = false;
  for (const auto& [front, back] : pairs) {
    const std::uint32_t shell = found.component_of[back];
    if (shell != found.component_of[front] && backs[shell] < found.components[shell].triangles)
      continue;
    keep[back] = 0;
    any = true;
  }
  keep_triangles(mesh, keep);
  return any;
}

}  // namespace

Mesh make_manifold(Mesh mesh, const Run& run) {
  remove_invalid(mesh, run);
  const std::vector<std::uint32_t> was = split_fans(mesh, run);
  if (remove_backs(mesh, was, run)) static_cast<void>(split_fans(mesh, run));
  return mesh;
}

std::size_t count_non_manifold_edges(const Mesh& mesh) {
  return count_non_manifold_edges(mesh, HalfEdges(mesh));
}

std::size_t count_non_manifold_edges(const Mesh& mesh, const HalfEdges& edges) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> ends;
  for (std::uint32_t edge = 0; edge < edges.count(); ++edge) {
    if (edges.has_twin(edge) || edges.is_boundary(edge)) continue;
    ends.push_back(std::minmax({source_vertex(mesh, edge), target_vertex(mesh, edge)}));
  }
  std::sort(ends.begin(), ends.end());
  return static_cast<std::size_t>(std::unique(ends.begin(), ends.end()) - ends.begin());
}

}  // namespace frangia
