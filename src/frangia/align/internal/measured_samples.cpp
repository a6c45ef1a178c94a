#include "frangia/align/internal/measured_samples.h"

#include <algorithm>
#include <cmath>

#include "frangia/core/error.h"
#include "frangia/core/random.h"
#include "frangia/geometry/sample_surface.h"
#include "frangia/geometry/vertex_data.h"

namespace frangia {

std::vector<MeasuredSample> measured_samples(const Mesh& mesh,
                                             std::size_t count,
                                             std::uint64_t seed) {
  Mesh measured;
  measured.vertices_mm = mesh.vertices_mm;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (mark_of(mesh, t) != Mark::Synthesized) measured.triangles.push_back(mesh.triangles[t]);
  std::vector<MeasuredSample> samples;
  for (const SurfaceSample& sample : sample_surface(measured, count, seed)) {
    double sigma = 0.0;
    if (!mesh.sigma_mm.empty()) {
      for (const std::uint32_t v : measured.triangles[sample.triangle])
        sigma = std::max(sigma, static_cast<double>(mesh.sigma_mm[v]));
    }
    samples.push_back({sample.point_mm, sample.normal, std::isfinite(sigma) ? sigma : 0.0});
  }
  require(!samples.empty(), "the mesh has no measured triangle with an area to align");
  for (std::size_t i = samples.size() - 1; i > 0; --i) {
    const double random = uniform_from(hash(hash(seed, 77U), i));
    std::swap(samples[i], samples[static_cast<std::size_t>(random * static_cast<double>(i + 1))]);
  }
  return samples;
}

}  // namespace frangia
