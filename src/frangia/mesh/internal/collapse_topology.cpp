#include "frangia/mesh/internal/collapse_topology.h"

namespace frangia {

CollapseTopology::CollapseTopology(Mesh& mesh, const HalfEdges& edges)
    : mesh_(&mesh),
      remaining_triangles_(mesh.triangles.size()),
      seen_(mesh.vertices_mm.size()),
      fixed_(mesh.vertices_mm.size()),
      on_boundary_(mesh.vertices_mm.size()),
      first_(mesh.vertices_mm.size(), kNone),
      next_corner_(3 * mesh.triangles.size(), kNone),
      alive_(mesh.triangles.size(), 1) {
  for (std::uint32_t corner = 0; corner < next_corner_.size(); ++corner) {
    next_corner_[corner] = first_[at(corner)];
    first_[at(corner)] = corner;
  }
  for (std::uint32_t edge = 0; edge < edges.count(); ++edge) {
    if (edges.has_twin(edge)) continue;
    auto& flags = edges.is_boundary(edge) ? on_boundary_ : fixed_;
    flags[source_vertex(mesh, edge)] = 1;
    flags[target_vertex(mesh, edge)] = 1;
  }
}

CollapseTopology::OneRingCounts CollapseTopology::mark_neighbors(std::uint32_t a,
                                                                 std::uint32_t b,
                                                                 std::uint32_t stamp) {
  OneRingCounts counts;
  for_each_corner(a, [&](std::uint32_t corner) {
    ++counts.triangles;
    const std::uint32_t next = at(HalfEdges::next(corner));
    const std::uint32_t last = at(HalfEdges::previous(corner));
    if (next == b || last == b) ++counts.shared_triangles;
    seen_[next] = seen_[last] = stamp;
  });
  return counts;
}

bool CollapseTopology::can_collapse(std::uint32_t a, std::uint32_t b) {
  const std::uint32_t stamp = ++stamp_;
  const OneRingCounts counts = mark_neighbors(a, b, stamp);
  const std::size_t shared_triangles = counts.shared_triangles;
  if (shared_triangles == 0 || shared_triangles > 2) return false;
  if (shared_triangles == 2 && on_boundary_[a] != 0 && on_boundary_[b] != 0) return false;
  std::size_t shared = 0;
  std::size_t triangles_of_b = 0;
  const std::uint32_t counted = ++stamp_;
  for_each_corner(b, [&](std::uint32_t corner) {
    ++triangles_of_b;
    for (const std::uint32_t v : {at(HalfEdges::next(corner)), at(HalfEdges::previous(corner))}) {
      if (seen_[v] != stamp) continue;
      seen_[v] = counted;
      ++shared;
    }
  });
  if (shared != shared_triangles) return false;
  return counts.triangles + triangles_of_b >=
         2 * shared_triangles + (shared_triangles == 2 ? 3 : 1);
}

void CollapseTopology::collapse(std::uint32_t a, std::uint32_t b) {
  for_each_corner(a, [&](std::uint32_t corner) {
    if (at(HalfEdges::next(corner)) != b && at(HalfEdges::previous(corner)) != b) return;
    alive_[corner / 3] = 0;
    --remaining_triangles_;
  });
  std::uint32_t head = kNone;
  for (const std::uint32_t end : {a, b}) {
    for (std::uint32_t corner = first_[end]; corner != kNone;) {
      const std::uint32_t next = next_corner_[corner];
      if (alive_[corner / 3] != 0) {
        mesh_->triangles[corner / 3][corner % 3] = a;
        next_corner_[corner] = head;
        head = corner;
      }
      corner = next;
    }
  }
  first_[b] = kNone;
  first_[a] = head;
  on_boundary_[a] |= on_boundary_[b];
}

void CollapseTopology::neighbors(std::uint32_t vertex, std::vector<std::uint32_t>& found) {
  found.clear();
  const std::uint32_t stamp = ++stamp_;
  for_each_corner(vertex, [&](std::uint32_t corner) {
    for (const std::uint32_t v : {at(HalfEdges::next(corner)), at(HalfEdges::previous(corner))}) {
      if (seen_[v] == stamp) continue;
      seen_[v] = stamp;
      found.push_back(v);
    }
  });
}

}  // namespace frangia
