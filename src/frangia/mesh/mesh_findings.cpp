#include "frangia/mesh/mesh_findings.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "frangia/core/missing.h"
#include "frangia/geometry/connectivity.h"
#include "frangia/geometry/triangles_intersect.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/mesh/make_manifold.h"
#include "frangia/mesh/self_intersections.h"

namespace frangia {
namespace {

/// Whether each edge is used as often in one direction as in the other.
bool is_balanced(const Mesh& mesh, const HalfEdges& edges) {
  struct Use {
    std::pair<std::uint32_t, std::uint32_t> ends;
    int direction;
  };
  std::vector<Use> uses;
  for (std::uint32_t edge = 0; edge < edges.count(); ++edge) {
    if (edges.has_twin(edge)) continue;
    if (edges.is_boundary(edge)) return false;
    const std::uint32_t from = source_vertex(mesh, edge);
    const std::uint32_t to = target_vertex(mesh, edge);
    uses.push_back({std::minmax(from, to), from < to ? 1 : from > to ? -1 : 0});
  }
  std::sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) { return a.ends < b.ends; });
  int sum = 0;
  for (std::size_t i = 0; i < uses.size(); ++i) {
    sum += uses[i].direction;
    const bool last = i + 1 == uses.size() || uses[i + 1].ends != uses[i].ends;
    if (last && sum != 0) return false;
  }
  return true;
}

}  // namespace

MeshFindings mesh_findings(const Mesh& mesh, const Run& run) {
  run.check();
  MeshFindings found;
  found.vertices = mesh.vertices_mm.size();
  found.triangles = mesh.triangles.size();
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& [ia, ib, ic] = mesh.triangles[i];
    const Eigen::Vector3d a = mesh.vertices_mm[ia].cast<double>();
    const Eigen::Vector3d b = mesh.vertices_mm[ib].cast<double>();
    const Eigen::Vector3d c = mesh.vertices_mm[ic].cast<double>();
    const double twice_area = (b - a).cross(c - a).norm();
    found.volume_mm3 += a.dot(b.cross(c)) / 6.0;
    found.area_mm2 += twice_area / 2.0;
    if (!(twice_area > 0.0)) ++found.degenerate_triangles;
    ++found.marks.at(static_cast<std::size_t>(mark_of(mesh, i)));
    found.box_mm.extend(a).extend(b).extend(c);
  }
  run.check();
  found.components = connected_components(mesh).components;
  run.check();
  const HalfEdges edges(mesh);
  run.check();
  found.holes = boundary_loops(mesh, edges);
  found.non_manifold_edges = count_non_manifold_edges(mesh, edges);
  bool open = false;
  for (std::uint32_t edge = 0; edge < edges.count(); ++edge)
    open = open || edges.is_boundary(edge);
  found.closed = !open && found.non_manifold_edges == 0 && !mesh.empty();
  if (mesh.empty() || !is_balanced(mesh, edges)) found.volume_mm3 = kMissing;
  run.check();
  if (can_test_intersections()) found.self_intersections = self_intersections(mesh, run).size();
  return found;
}

}  // namespace frangia
