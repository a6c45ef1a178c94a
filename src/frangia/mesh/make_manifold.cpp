#include "frangia/mesh/make_manifold.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/disjoint_sets.h"
#include "frangia/geometry/clean_mesh.h"
#include "frangia/geometry/half_edges.h"
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

/// Removes invalid triangles and all but the first of those with the same corners.
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
        const bool same =
            sorted(mesh.triangles[sorted_by[a]]) == sorted(mesh.triangles[sorted_by[b]]);
        if (same) keep[sorted_by[b]] = 0;
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

/// Splits non-manifold edges and vertices with several fans: each fan gets its own vertex.
void split_fans(Mesh& mesh, const Run& run) {
  const HalfEdges edges(mesh);
  DisjointSets corners(edges.count());
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
      if (lowest && source_vertex(mesh, edge) < target_vertex(mesh, edge))
        pair_triangles(mesh, edges, edge, corners);
    }
  }
  constexpr std::uint32_t kNone = 0xFFFFFFFF;
  std::vector<std::uint32_t> owner(mesh.vertices_mm.size(), kNone);  // the fan that keeps a vertex
  std::vector<std::uint32_t> added(edges.count(), kNone);
  std::vector<Triangle> new_index = mesh.triangles;
  for (std::uint32_t corner = 0; corner < edges.count(); ++corner) {
    const std::uint32_t fan = corners.find(corner);
    const std::uint32_t vertex = source_vertex(mesh, corner);
    if (owner[vertex] == kNone) owner[vertex] = fan;
    if (owner[vertex] == fan) continue;
    if (added[fan] == kNone) added[fan] = copy_vertex(mesh, vertex);
    new_index[corner / 3][corner % 3] = added[fan];
  }
  mesh.triangles = std::move(new_index);
}

}  // namespace

Mesh make_manifold(Mesh mesh, const Run& run) {
  remove_invalid(mesh, run);
  split_fans(mesh, run);
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
