#include "frangia/mesh/smooth_limits.h"

#include <cmath>

#include "frangia/core/error.h"

namespace frangia {

SmoothLimits::SmoothLimits(const Mesh& mesh, const HalfEdges& edges, const SmoothOptions& options)
    : begin_mm_(mesh.vertices_mm), free_(mesh.vertices_mm.size(), 1) {
  require(options.iterations >= 0 && options.max_sigmas >= 0.0,
          "smooth: iterations and sigmas must not be negative");
  if (!options.only.empty()) {
    require(options.only.size() == mesh.triangles.size(),
            "smooth: there must be one flag a triangle");
    free_.assign(free_.size(), 0);
    for (std::size_t i = 0; i < options.only.size(); ++i) {
      for (const std::uint32_t vertex : mesh.triangles[i])
        if (options.only[i] != 0) free_[vertex] = 1;
    }
  }
  for (std::uint32_t edge = 0; edge < edges.count(); ++edge) {
    if (edges.has_twin(edge)) continue;
    free_[from_of(mesh, edge)] = 0;
    free_[to_of(mesh, edge)] = 0;
  }
  if (options.max_sigmas == 0.0) return;
  for (const float sigma : mesh.sigma_mm) {
    const bool known = std::isfinite(sigma) && sigma > 0.0F;
    reach_mm_.push_back(known ? static_cast<float>(options.max_sigmas) * sigma : 0.0F);
  }
}

Eigen::Vector3f SmoothLimits::allowed(std::size_t vertex, const Eigen::Vector3f& wanted) const {
  if (reach_mm_.empty()) return wanted;
  const Eigen::Vector3f way = wanted - begin_mm_[vertex];
  const float length = way.norm();
  if (length <= reach_mm_[vertex]) return wanted;
  return begin_mm_[vertex] + way * (reach_mm_[vertex] / length);
}

}  // namespace frangia
