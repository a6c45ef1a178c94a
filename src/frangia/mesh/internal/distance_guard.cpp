#include "frangia/mesh/internal/distance_guard.h"

#include <algorithm>
#include <array>
#include <limits>
#include <span>

#include "frangia/core/parallel.h"
#include "frangia/geometry/hausdorff_distance.h"
#include "frangia/geometry/selection.h"
#include "frangia/geometry/surface_samples.h"
#include "frangia/geometry/triangle_predicates.h"
#include "frangia/geometry/vertex_data.h"

namespace frangia {

using Eigen::Vector3d;

namespace {

// Avoids a division by 0 for a mesh whose vertices coincide.
constexpr double kMinEdgeMm = std::numeric_limits<float>::min();

constexpr std::size_t kTrianglesPerChunk = 8192;
constexpr std::size_t kMostTriangles = 64;  // of a vertex; at a hub of more, Embree is faster

Vector3d position_of(const Mesh& mesh, std::uint32_t vertex) {
  return mesh.vertices_mm[vertex].cast<double>();
}

/// Squared distance of a point from a triangle of a mesh.
double square_from(const Mesh& mesh, std::uint32_t triangle, const Vector3d& point) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  return (nearest_on_triangle(
              position_of(mesh, a), position_of(mesh, b), position_of(mesh, c), point) -
          point)
      .squaredNorm();
}

/// The triangles that are left, and were there with the same corners in an earlier mesh, which may
/// be empty.
std::vector<std::uint8_t> unchanged_triangles(const Mesh& mesh,
                                              const std::vector<std::uint8_t>& alive,
                                              const Mesh& earlier) {
  std::vector<std::uint8_t> same(alive.size());
  if (earlier.empty()) return same;
  for (std::size_t t = 0; t < same.size(); ++t) {
    const Mesh::Triangle& corners = mesh.triangles[t];
    same[t] = alive[t] != 0 && corners == earlier.triangles[t] &&
                      std::all_of(corners.begin(),
                                  corners.end(),
                                  [&](std::uint32_t v) {
                                    return mesh.vertices_mm[v] == earlier.vertices_mm[v];
                                  })
                  ? 1
                  : 0;
  }
  return same;
}

}  // namespace

DistanceGuard::DistanceGuard(const RayScene& original, const HalfEdges& edges, double distance_mm)
    : original_(&original),
      edges_(&edges),
      distance_mm_(distance_mm),
      spacing_mm_(std::max(mean_edge_length_mm(original.mesh()), kMinEdgeMm) / 3.0),
      next_(original.mesh().vertices_mm.size(), kNone),
      first_(original.mesh().triangles.size(), kNone) {
  const Mesh& mesh = original.mesh();
  std::vector<std::uint8_t> added(mesh.vertices_mm.size());
  for (std::uint32_t corner = 0; corner < edges.count(); ++corner) {
    const std::uint32_t vertex = source_vertex(mesh, corner);
    if (added[vertex] != 0) continue;
    added[vertex] = 1;
    next_[vertex] = first_[corner / 3];
    first_[corner / 3] = vertex;
  }
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
    remaining_.push_back({corner / 3, target_mm, position_of(mesh, next), position_of(mesh, last)});
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

/// Walks along the edges of the original to vertices nearer and nearer to a point.
std::uint32_t DistanceGuard::walk(const Vector3d& point, std::uint32_t from) const {
  const Mesh& mesh = original_->mesh();
  double nearest = (position_of(mesh, from) - point).squaredNorm();
  while (edges_->outgoing(from).size() <= kMostTriangles) {
    std::uint32_t best = from;
    const auto try_vertex = [&](std::uint32_t vertex) {
      const double square = (position_of(mesh, vertex) - point).squaredNorm();
      if (square >= nearest) return;
      nearest = square;
      best = vertex;
    };
    for (const std::uint32_t edge : edges_->outgoing(from)) {
      try_vertex(target_vertex(mesh, edge));
      // Within the surface it is the target of the next one.
      if (!edges_->has_twin(HalfEdges::previous(edge))) try_vertex(opposite_vertex(mesh, edge));
    }
    if (best == from) return from;
    from = best;
  }
  return from;
}

/// Whether a point is within a distance of the original. Most points lie beside the triangle of the
/// point before. Where the walk ends at another part of the surface, Embree decides.
bool DistanceGuard::is_near(const Vector3d& point, double distance_mm, Start& start) const {
  const double most = distance_mm * distance_mm;
  if (start.triangle != kNone && square_from(original_->mesh(), start.triangle, point) <= most)
    return true;
  if (start.vertex != kNone) {
    start.vertex = walk(point, start.vertex);
    const auto edges = edges_->outgoing(start.vertex);
    for (const std::uint32_t edge : edges.first(std::min(edges.size(), kMostTriangles))) {
      if (square_from(original_->mesh(), edge / 3, point) > most) continue;
      start.triangle = edge / 3;
      return true;
    }
  }
  return original_->nearest(point, distance_mm).has_value();
}

bool DistanceGuard::is_fine() const {
  constexpr double kFine = 7.0;  // limits between two vertices
  return spacing_mm_ < kFine * distance_mm_;
}

double DistanceGuard::plain_distance_mm() const {
  constexpr double kFar = 0.25;  // of the limit
  return kFar * distance_mm_;
}

void DistanceGuard::assign(const CollapseTopology& topology,
                           const Mesh& mesh,
                           const std::vector<std::uint32_t>& ends) {
  std::fill(next_.begin(), next_.end(), kNone);
  std::fill(first_.begin(), first_.end(), kNone);
  std::vector<std::uint32_t> around;
  for (std::uint32_t v = 0; v < ends.size(); ++v) {
    if (topology.is_removed(ends[v])) continue;  // of no triangle
    const Vector3d point = position_of(original_->mesh(), v);
    double nearest = distance_mm_ * distance_mm_;
    std::uint32_t owner = kNone;
    const auto try_ring = [&](std::uint32_t center) {
      topology.for_each_corner(center, [&](std::uint32_t corner) {
        const double square = square_from(mesh, corner / 3, point);
        if (square > nearest) return;
        nearest = square;
        owner = corner / 3;
      });
    };
    try_ring(ends[v]);
    if (owner == kNone) {
      around.clear();
      topology.for_each_corner(ends[v], [&](std::uint32_t corner) {
        around.push_back(topology.at(HalfEdges::next(corner)));
        around.push_back(topology.at(HalfEdges::previous(corner)));
      });
      for (const std::uint32_t center : around)
        try_ring(center);
    }
    if (owner == kNone) continue;
    next_[v] = first_[owner];
    first_[owner] = v;
  }
}

bool DistanceGuard::allows(const CollapseTopology& topology,
                           const Mesh& mesh,
                           std::uint32_t a,
                           std::uint32_t b,
                           const CollapseTarget& target) {
  const Vector3d& target_mm = target.position;
  removed_.clear();
  remaining_.clear();
  reassigned_.clear();
  owners_.clear();
  gather(topology, mesh, a, b, target_mm);
  gather(topology, mesh, b, a, target_mm);
  for (const std::uint32_t triangle : removed_) {
    for (std::uint32_t v = first_[triangle]; v != kNone; v = next_[v]) {
      const std::uint32_t owner = nearest_triangle(position_of(original_->mesh(), v));
      if (owner == kNone) return false;
      reassigned_.push_back(v);
      owners_.push_back(owner);
    }
  }
  if (is_fine() && target.mean_square < plain_distance_mm() * plain_distance_mm()) return true;
  Start start{.vertex = reassigned_.empty() ? kNone : reassigned_.front()};
  return is_near(target_mm, distance_mm_, start) &&
         std::all_of(remaining_.begin(), remaining_.end(), [&](const Triangle& t) {
           return is_near((t.a + t.b + t.c) / 3.0, distance_mm_, start) &&
                  is_near(0.5 * (t.a + t.b), distance_mm_, start);
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

/// The distance from a triangle is a convex function, so that a triangle whose corners are assigned
/// to one triangle is as near to it as they are.
void DistanceGuard::check_original(const Mesh& mesh,
                                   const std::vector<std::uint8_t>& alive,
                                   double distance_mm,
                                   const std::vector<std::uint8_t>& same,
                                   CheckedSurface& checked,
                                   const Run& run,
                                   std::vector<std::uint32_t>& beyond) const {
  const Mesh& original = original_->mesh();
  std::vector<std::uint32_t> owner(original.vertices_mm.size(), kNone);
  for (std::uint32_t t = 0; t < alive.size(); ++t)
    for (std::uint32_t v = alive[t] != 0 ? first_[t] : kNone; v != kNone; v = next_[v])
      owner[v] = t;
  checked.owner.resize(owner.size(), kNone);
  checked.original_near.resize(original.triangles.size());
  const auto is_known = [&](std::size_t i) {
    const Mesh::Triangle& t = original.triangles[i];
    return checked.original_near[i] != 0 && std::all_of(t.begin(), t.end(), [&](std::uint32_t v) {
             return owner[v] != kNone && owner[v] == checked.owner[v] && same[owner[v]] != 0;
           });
  };
  std::vector<std::uint8_t> near(original.triangles.size(), 1);
  struct Sample {
    Vector3d point;
    std::uint32_t triangle;
  };
  const std::size_t count = original.triangles.size();
  std::vector<std::vector<Sample>> unknown((count + kTrianglesPerChunk - 1) / kTrianglesPerChunk);
  interruptible_chunks(count, kTrianglesPerChunk, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (is_known(i)) continue;
      const Mesh::Triangle& t = original.triangles[i];
      const std::array owners{owner[t[0]], owner[t[1]], owner[t[2]]};
      const auto check = [&](const Vector3d& point) {
        const bool is_near = std::any_of(owners.begin(), owners.end(), [&](std::uint32_t one) {
          return one != kNone && square_from(mesh, one, point) <= distance_mm * distance_mm;
        });
        if (is_near) return;
        near[i] = 0;
        unknown[begin / kTrianglesPerChunk].push_back({point, static_cast<std::uint32_t>(i)});
      };
      if (owners[0] != kNone && owners[0] == owners[1] && owners[1] == owners[2]) continue;
      static_cast<void>(all_triangle_samples(position_of(original, t[0]),
                                             position_of(original, t[1]),
                                             position_of(original, t[2]),
                                             spacing_mm_,
                                             [&](const Vector3d& point) {
                                               check(point);
                                               return true;
                                             }));
    }
  });
  checked.owner = std::move(owner);
  checked.original_near = std::move(near);
  if (std::all_of(unknown.begin(), unknown.end(), [](const auto& one) { return one.empty(); }))
    return;
  Mesh present;
  present.vertices_mm = mesh.vertices_mm;
  for (std::size_t t = 0; t < alive.size(); ++t)
    if (alive[t] != 0) present.triangles.push_back(mesh.triangles[t]);
  const RayScene scene(std::move(present), run);
  for (const auto& samples : unknown) {
    for (const Sample& sample : samples) {
      if (scene.nearest(sample.point, distance_mm)) continue;
      const Mesh::Triangle& t = original.triangles[sample.triangle];
      beyond.insert(beyond.end(), t.begin(), t.end());
    }
  }
}

void DistanceGuard::check_present(const Mesh& mesh,
                                  const std::vector<std::uint8_t>& alive,
                                  double distance_mm,
                                  const std::vector<std::uint8_t>& same,
                                  CheckedSurface& checked,
                                  const Run& run,
                                  std::vector<std::uint32_t>& beyond) const {
  const std::size_t count = alive.size();
  checked.near.resize(count);
  std::vector<std::vector<std::uint32_t>> found((count + kTrianglesPerChunk - 1) /
                                                kTrianglesPerChunk);
  interruptible_chunks(count, kTrianglesPerChunk, run, [&](std::size_t begin, std::size_t end) {
    auto& here = found[begin / kTrianglesPerChunk];
    for (std::size_t i = begin; i < end; ++i) {
      if (alive[i] == 0 || (same[i] != 0 && checked.near[i] != 0)) continue;
      const auto& [a, b, c] = mesh.triangles[i];
      checked.near[i] = 1;
      Start start{.vertex = first_[i]};
      static_cast<void>(all_triangle_samples(position_of(mesh, a),
                                             position_of(mesh, b),
                                             position_of(mesh, c),
                                             spacing_mm_,
                                             [&](const Vector3d& point) {
                                               if (is_near(point, distance_mm, start)) return true;
                                               checked.near[i] = 0;
                                               if (const auto nearest = original_->nearest(point)) {
                                                 const Mesh::Triangle& t =
                                                     original_->mesh().triangles[nearest->triangle];
                                                 here.insert(here.end(), t.begin(), t.end());
                                               }
                                               return true;
                                             }));
    }
  });
  for (const auto& here : found)
    beyond.insert(beyond.end(), here.begin(), here.end());
}

std::vector<std::uint32_t> DistanceGuard::vertices_beyond(const Mesh& mesh,
                                                          const std::vector<std::uint8_t>& alive,
                                                          double distance_mm,
                                                          CheckedSurface& checked,
                                                          const Run& run) const {
  std::vector<std::uint32_t> beyond;
  const std::vector<std::uint8_t> same = unchanged_triangles(mesh, alive, checked.mesh);
  check_original(mesh, alive, distance_mm, same, checked, run, beyond);
  check_present(mesh, alive, distance_mm, same, checked, run, beyond);
  checked.mesh.vertices_mm = mesh.vertices_mm;
  checked.mesh.triangles = mesh.triangles;
  std::sort(beyond.begin(), beyond.end());
  beyond.erase(std::unique(beyond.begin(), beyond.end()), beyond.end());
  return beyond;
}

}  // namespace frangia
