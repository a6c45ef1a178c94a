#include "frangia/geometry/surface_samples.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "frangia/core/random.h"
#include "frangia/geometry/internal/triangle_area.h"

namespace frangia {
std::vector<SurfaceSample> sample_surface(const Mesh& mesh, std::size_t count, std::uint64_t seed) {
  std::vector<double> area_until(mesh.triangles.size());
  double area = 0.0;
  for (std::size_t i = 0; i < area_until.size(); ++i) {
    const double own = 0.5 * doubled_area_vector(mesh, i).norm();
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
    samples.push_back({(1.0 - root) * corner_mm(mesh, triangle, 0) +
                           root * (1.0 - along) * corner_mm(mesh, triangle, 1) +
                           root * along * corner_mm(mesh, triangle, 2),
                       doubled_area_vector(mesh, triangle).normalized(),
                       static_cast<std::uint32_t>(triangle)});
  }
  return samples;
}

}  // namespace frangia
