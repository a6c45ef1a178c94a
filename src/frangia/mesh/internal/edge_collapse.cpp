#include "frangia/mesh/internal/edge_collapse.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/statistics.h"
#include "frangia/geometry/vertex_data.h"

namespace frangia {
namespace {

using Eigen::Vector3d;

// Weight of a boundary edge relative to a triangle of the same size: boundaries have planes on one
// side only. Garland & Heckbert 1997 use a "large penalty factor".
constexpr double kBoundaryWeight = 10.0;

/// The median of the known sigmas; 0 without any.
double median_noise_mm(const Mesh& mesh) {
  std::vector<float> known;
  for (const float sigma : noise_mm_of(mesh))
    if (std::isfinite(sigma) && sigma > 0.0F) known.push_back(sigma);
  return static_cast<double>(median(std::move(known)));
}

}  // namespace

CollapseCost::CollapseCost(const Mesh& mesh, const HalfEdges& edges)
    : mesh_(&mesh), median_sigma_mm_(median_noise_mm(mesh)), quadrics_(mesh.vertices_mm.size()) {
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& triangle = mesh.triangles[t];
    const Vector3d cross = (position(triangle[1]) - position(triangle[0]))
                               .cross(position(triangle[2]) - position(triangle[0]));
    const double length = cross.norm();
    if (!(length > 0.0)) continue;
    const double weight = length * confidence(triangle);
    for (const std::uint32_t vertex : triangle)
      quadrics_[vertex].add_plane(cross / length, position(triangle[0]), weight);
    for (std::uint32_t edge = 3 * t; edge < 3 * t + 3; ++edge)
      if (edges.is_boundary(edge)) constrain_boundary(edge, cross / length);
  }
}

/// The weight (median sigma / sigma)^2 of a triangle, limited to [1/4, 4].
double CollapseCost::confidence(const Mesh::Triangle& triangle) const {
  if (!(median_sigma_mm_ > 0.0)) return 1.0;
  double sum = 0.0;
  for (const std::uint32_t vertex : triangle) {
    const auto sigma = static_cast<double>(noise_mm_of(*mesh_)[vertex]);
    const double ratio = sigma > 0.0 ? median_sigma_mm_ / sigma : 0.5;
    sum += std::clamp(ratio * ratio, 0.25, 4.0) / 3.0;
  }
  return sum;
}

void CollapseCost::constrain_boundary(std::uint32_t edge, const Vector3d& normal) {
  const std::uint32_t a = source_vertex(*mesh_, edge);
  const std::uint32_t b = target_vertex(*mesh_, edge);
  const Vector3d along = position(b) - position(a);
  const Vector3d side = along.cross(normal).stableNormalized();
  for (const std::uint32_t v : {a, b})
    quadrics_[v].add_plane(side, position(a), kBoundaryWeight * along.squaredNorm());
}

CollapseTarget CollapseCost::target(std::uint32_t a, std::uint32_t b) const {
  Quadric sum = quadrics_[a];
  sum += quadrics_[b];
  const Vector3d pa = position(a);
  const Vector3d pb = position(b);
  const Vector3d middle = 0.5 * (pa + pb);
  Vector3d best;
  const bool has_minimum = sum.minimize(best);
  if (!has_minimum || (best - middle).squaredNorm() > (pa - pb).squaredNorm()) {
    best = middle;
    for (const Vector3d& other : {pa, pb})
      if (sum.at(other) < sum.at(best)) best = other;
  }
  const double cost = sum.at(best);
  return {best, cost, sum.weight > 0.0 ? cost / sum.weight : 0.0};
}

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
