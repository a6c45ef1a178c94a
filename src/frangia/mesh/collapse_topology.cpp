#include "frangia/mesh/collapse_topology.h"

namespace frangia {

CollapseTopology::CollapseTopology(Mesh& mesh, const HalfEdges& edges)
    : mesh_(&mesh),
      living_(mesh.triangles.size()),
      seen_(mesh.vertices_mm.size()),
      fixed_(mesh.vertices_mm.size()),
      open_(mesh.vertices_mm.size()),
      first_(mesh.vertices_mm.size(), kNone),
      following_(3 * mesh.triangles.size(), kNone),
      alive_(mesh.triangles.size(), 1) {
  for (std::uint32_t corner = 0; corner < following_.size(); ++corner) {
    following_[corner] = first_[at(corner)];
    first_[at(corner)] = corner;
  }
  for (std::uint32_t edge = 0; edge < edges.count(); ++edge) {
    if (edges.has_twin(edge)) continue;
    auto& flags = edges.is_boundary(edge) ? open_ : fixed_;
    flags[from_of(mesh, edge)] = 1;
    flags[to_of(mesh, edge)] = 1;
  }
}

CollapseTopology::Beside CollapseTopology::mark_neighbors(std::uint32_t a,
                                                          std::uint32_t b,
                                                          std::uint32_t stamp) {
  Beside beside;
  around(a, [&](std::uint32_t corner) {
    ++beside.triangles;
    const std::uint32_t next = at(HalfEdges::next(corner));
    const std::uint32_t last = at(HalfEdges::before(corner));
    if (next == b || last == b) ++beside.shared_triangles;
    seen_[next] = seen_[last] = stamp;
  });
  return beside;
}

bool CollapseTopology::may_join(std::uint32_t a, std::uint32_t b) {
  const std::uint32_t stamp = ++stamp_;
  const Beside beside = mark_neighbors(a, b, stamp);
  const std::size_t both = beside.shared_triangles;
  if (both == 0 || both > 2) return false;
  if (both == 2 && open_[a] != 0 && open_[b] != 0) return false;
  std::size_t shared = 0;
  std::size_t beside_b = 0;
  const std::uint32_t counted = ++stamp_;
  around(b, [&](std::uint32_t corner) {
    ++beside_b;
    for (const std::uint32_t v : {at(HalfEdges::next(corner)), at(HalfEdges::before(corner))}) {
      if (seen_[v] != stamp) continue;
      seen_[v] = counted;
      ++shared;
    }
  });
  if (shared != both) return false;
  return beside.triangles + beside_b >= 2 * both + (both == 2 ? 3 : 1);
}

void CollapseTopology::join(std::uint32_t a, std::uint32_t b) {
  around(a, [&](std::uint32_t corner) {
    if (at(HalfEdges::next(corner)) != b && at(HalfEdges::before(corner)) != b) return;
    alive_[corner / 3] = 0;
    --living_;
  });
  std::uint32_t head = kNone;
  for (const std::uint32_t end : {a, b}) {
    for (std::uint32_t corner = first_[end]; corner != kNone;) {
      const std::uint32_t next = following_[corner];
      if (alive_[corner / 3] != 0) {
        mesh_->triangles[corner / 3][corner % 3] = a;
        following_[corner] = head;
        head = corner;
      }
      corner = next;
    }
  }
  first_[b] = kNone;
  first_[a] = head;
  open_[a] |= open_[b];
}

void CollapseTopology::neighbors(std::uint32_t vertex, std::vector<std::uint32_t>& found) {
  found.clear();
  const std::uint32_t stamp = ++stamp_;
  around(vertex, [&](std::uint32_t corner) {
    for (const std::uint32_t v : {at(HalfEdges::next(corner)), at(HalfEdges::before(corner))}) {
      if (seen_[v] == stamp) continue;
      seen_[v] = stamp;
      found.push_back(v);
    }
  });
}

}  // namespace frangia
