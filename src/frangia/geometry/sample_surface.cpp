#include "frangia/geometry/sample_surface.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "frangia/core/random.h"

namespace frangia {
namespace {

Eigen::Vector3d corner(const Mesh& mesh, std::size_t triangle, std::size_t index) {
  return mesh.vertices_mm[mesh.triangles[triangle][index]].cast<double>();
}

Eigen::Vector3d area_vector(const Mesh& mesh, std::size_t triangle) {
  const Eigen::Vector3d a = corner(mesh, triangle, 0);
  return 0.5 * (corner(mesh, triangle, 1) - a).cross(corner(mesh, triangle, 2) - a);
}

}  // namespace

std::vector<SurfaceSample> sample_surface(const Mesh& mesh, std::size_t count, std::uint64_t seed) {
  std::vector<double> area_until(mesh.triangles.size());
  double area = 0.0;
  for (std::size_t i = 0; i < area_until.size(); ++i) {
    const double own = area_vector(mesh, i).norm();
    if (std::isfinite(own)) area += own;
    area_until[i] = area;
  }
  std::vector<SurfaceSample> samples;
  if (!(area > 0.0)) return samples;
  samples.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t stream = hash(seed, i);
    const double place =
        (static_cast<double>(i) + uniform_from(stream)) / static_cast<double>(count) * area;
    const auto found = std::upper_bound(area_until.begin(), area_until.end(), place);
    const auto triangle =
        static_cast<std::size_t>(std::min(found, area_until.end() - 1) - area_until.begin());
    // Uniform over the triangle: Turk 1990.
    const double root = std::sqrt(uniform_from(hash(stream, 1)));
    const double along = uniform_from(hash(stream, 2));
    samples.push_back({(1.0 - root) * corner(mesh, triangle, 0) +
                           root * (1.0 - along) * corner(mesh, triangle, 1) +
                           root * along * corner(mesh, triangle, 2),
                       area_vector(mesh, triangle).normalized(),
                       static_cast<std::uint32_t>(triangle)});
  }
  return samples;
}

}  // namespace frangia
