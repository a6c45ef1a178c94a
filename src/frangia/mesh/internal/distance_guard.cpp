#include "frangia/mesh/internal/distance_guard.h"

#include <algorithm>
#include <limits>

#include "frangia/geometry/hausdorff_distance.h"
#include "frangia/geometry/nearest_on_triangle.h"
#include "frangia/geometry/triangle_samples.h"

namespace frangia {

using Eigen::Vector3d;

namespace {

// Avoids a division by 0 for a mesh whose vertices coincide.
constexpr double kMinEdgeMm = std::numeric_limits<float>::min();

Eigen::Vector3f centroid_of(const Mesh& mesh, std::uint32_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  return (mesh.vertices_mm[a] + mesh.vertices_mm[b] + mesh.vertices_mm[c]) / 3.0F;
}

}  // namespace

DistanceGuard::DistanceGuard(const RayScene& original, const HalfEdges& edges, double distance_mm)
    : original_(&original),
      distance_mm_(distance_mm),
      spacing_mm_(0.5 * std::max(mean_edge_length_mm(original.mesh()), kMinEdgeMm)),
      first_(original.mesh().triangles.size(), kNone) {
  const Mesh& mesh = original.mesh();
  std::vector<std::uint8_t> added(mesh.vertices_mm.size());
  for (std::uint32_t edge = 0; edge < edges.count(); ++edge) {
    const std::uint32_t from = source_vertex(mesh, edge);
    if (added[from] == 0) add_point(mesh.vertices_mm[from], edge / 3);
    added[from] = 1;
    if (edge % 3 == 0) add_point(centroid_of(mesh, edge / 3), edge / 3);
    if (edges.has_twin(edge) && edges.twin(edge) < edge) continue;
    add_point(0.5F * (mesh.vertices_mm[from] + mesh.vertices_mm[target_vertex(mesh, edge)]),
              edge / 3);
  }
}

void DistanceGuard::add_point(const Eigen::Vector3f& position, std::uint32_t triangle) {
  next_.push_back(first_[triangle]);
  first_[triangle] = static_cast<std::uint32_t>(points_mm_.size());
  points_mm_.push_back(position);
}

void DistanceGuard::gather(const CollapseTopology& topology,
                           const Mesh& mesh,
                           std::uint32_t vertex,
                           std::uint32_t other,
                           const Vector3d& target_mm) {
  topology.for_each_corner(vertex, [&](std::uint32_t corner) {
    const std::uint32_t next = topology.at(HalfEdges::next(corner));
    const std::uint32_t last = topology.at(HalfEdges::previous(corner));
    const bool is_removed = next == other || last == other;
    if (is_removed && vertex > other) return;  // counted from the other end
    removed_.push_back(corner / 3);
    if (is_removed) return;
    remaining_.push_back({corner / 3,
                          target_mm,
                          mesh.vertices_mm[next].cast<double>(),
                          mesh.vertices_mm[last].cast<double>()});
  });
}

std::uint32_t DistanceGuard::nearest_triangle(const Vector3d& point) const {
  double nearest = distance_mm_ * distance_mm_;
  std::uint32_t owner = kNone;
  for (const Triangle& t : remaining_) {
    const double square = (nearest_on_triangle(t.a, t.b, t.c, point) - point).squaredNorm();
    if (square > nearest) continue;
    nearest = square;
    owner = t.number;
  }
  return owner;
}

bool DistanceGuard::allows(const CollapseTopology& topology,
                           const Mesh& mesh,
                           std::uint32_t a,
                           std::uint32_t b,
                           const Vector3d& target_mm) {
  removed_.clear();
  remaining_.clear();
  reassigned_.clear();
  owners_.clear();
  gather(topology, mesh, a, b, target_mm);
  gather(topology, mesh, b, a, target_mm);
  for (const std::uint32_t triangle : removed_) {
    for (std::uint32_t p = first_[triangle]; p != kNone; p = next_[p]) {
      const std::uint32_t owner = nearest_triangle(points_mm_[p].cast<double>());
      if (owner == kNone) return false;
      reassigned_.push_back(p);
      owners_.push_back(owner);
    }
  }
  const auto is_near = [&](const Vector3d& position) {
    return original_->nearest(position, distance_mm_).has_value();
  };
  return is_near(target_mm) &&
         std::all_of(remaining_.begin(), remaining_.end(), [&](const Triangle& t) {
           return all_triangle_samples(t.a, t.b, t.c, spacing_mm_, is_near);
         });
}

void DistanceGuard::accept() {
  for (const std::uint32_t triangle : removed_)
    first_[triangle] = kNone;
  for (std::size_t i = 0; i < reassigned_.size(); ++i) {
    next_[reassigned_[i]] = first_[owners_[i]];
    first_[owners_[i]] = reassigned_[i];
  }
}

}  // namespace frangia
