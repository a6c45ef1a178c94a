#include "frangia/geometry/pick_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/parallel.h"

namespace frangia {
namespace {

constexpr std::size_t kPickChunk = 1 << 16;
constexpr double kNowhere = std::numeric_limits<double>::infinity();

struct Nearest {
  double along = kNowhere;  ///< in lengths of the ray's direction
  std::size_t triangle = 0;
};

/// Distance along the ray at which it meets a triangle.
double meet(const PickRay& ray,
            const Eigen::Vector3d& a,
            const Eigen::Vector3d& b,
            const Eigen::Vector3d& c) {
  const Eigen::Vector3d ab = b - a;
  const Eigen::Vector3d ac = c - a;
  const Eigen::Vector3d p = ray.direction.cross(ac);
  const double determinant = ab.dot(p);
  if (determinant == 0.0) return kNowhere;
  const Eigen::Vector3d s = ray.eye_mm - a;
  const double u = s.dot(p) / determinant;
  if (!(u >= 0.0 && u <= 1.0)) return kNowhere;
  const Eigen::Vector3d q = s.cross(ab);
  const double v = ray.direction.dot(q) / determinant;
  if (!(v >= 0.0 && u + v <= 1.0)) return kNowhere;
  const double along = ac.dot(q) / determinant;
  if (!(along > 0.0)) return kNowhere;
  return along;
}

}  // namespace

std::optional<PickedPoint> pick_surface(const Mesh& mesh, const PickRay& ray) {
  const std::size_t count = mesh.triangles.size();
  std::vector<Nearest> nearest((count + kPickChunk - 1) / kPickChunk);
  const auto corner = [&](std::uint32_t vertex) {
    return Eigen::Vector3d(mesh.vertices_mm[vertex].cast<double>());
  };
  const auto at = [&](double along) -> Eigen::Vector3d {
    return ray.eye_mm + along * ray.direction;
  };
  parallel_chunks(count, kPickChunk, [&](std::size_t begin, std::size_t end) {
    Nearest& best = nearest[begin / kPickChunk];
    for (std::size_t i = begin; i < end; ++i) {
      const auto& [a, b, c] = mesh.triangles[i];
      const double along = meet(ray, corner(a), corner(b), corner(c));
      if (!(along < best.along)) continue;
      if (ray.section_normal.dot(at(along)) + ray.section_offset_mm < 0.0) continue;
      best = {along, i};
    }
  });
  Nearest first;
  for (const Nearest& one : nearest)
    if (one.along < first.along) first = one;
  if (!std::isfinite(first.along)) return std::nullopt;
  PickedPoint picked{.point_mm = at(first.along),
                     .triangle = static_cast<std::uint32_t>(first.triangle)};
  if (mesh.sigma_mm.empty()) return picked;
  const auto& [a, b, c] = mesh.triangles[first.triangle];
  const float largest = std::max({mesh.sigma_mm[a], mesh.sigma_mm[b], mesh.sigma_mm[c]});
  const bool known = std::isfinite(mesh.sigma_mm[a]) && std::isfinite(mesh.sigma_mm[b]) &&
                     std::isfinite(mesh.sigma_mm[c]);
  if (known) picked.sigma_mm = static_cast<double>(largest);
  return picked;
}

}  // namespace frangia
