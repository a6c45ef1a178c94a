#include "frangia/mesh/internal/collapse_cost.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/median.h"
#include "frangia/geometry/vertex_data.h"

namespace frangia {
namespace {

using Eigen::Vector3d;

// Weight of a boundary edge relative to a triangle of the same size: boundaries have planes on one
// side only. Garland & Heckbert 1997 use a "large penalty factor".
constexpr double kBoundaryWeight = 10.0;

/// The median of the known sigmas; 0 without any.
double median_sigma(const Mesh& mesh) {
  std::vector<float> known;
  for (const float sigma : noise_mm_of(mesh))
    if (std::isfinite(sigma) && sigma > 0.0F) known.push_back(sigma);
  return static_cast<double>(median(std::move(known)));
}

}  // namespace

CollapseCost::CollapseCost(const Mesh& mesh, const HalfEdges& edges)
    : mesh_(&mesh), median_sigma_mm_(median_sigma(mesh)), quadrics_(mesh.vertices_mm.size()) {
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

}  // namespace frangia
