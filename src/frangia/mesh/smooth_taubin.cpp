#include <vector>

#include "frangia/core/parallel.h"
#include "frangia/mesh/half_edges.h"
#include "frangia/mesh/smooth.h"
#include "frangia/mesh/smooth_limits.h"
#include "frangia/mesh/vertex_data.h"

namespace frangia {
namespace {

constexpr std::size_t kChunk = 8192;
constexpr float kShrink = 0.5F;
constexpr float kSwell = -0.51F;  // passes shapes of more than some thirty edges unchanged

/// Every vertex goes this share of the way to the mean of its neighbours, as far as that is along
/// its normal: to the side there is no noise, and vertices that wander would use their bound up.
void step(Mesh& mesh,
          const HalfEdges& edges,
          const SmoothLimits& limits,
          const std::vector<Eigen::Vector3f>& normals,
          float share) {
  const std::vector<Eigen::Vector3f> from = mesh.vertices_mm;
  parallel_chunks(from.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const auto leaving = edges.leaving(static_cast<std::uint32_t>(v));
      if (!limits.may_move(v) || leaving.empty()) continue;
      Eigen::Vector3f mean = Eigen::Vector3f::Zero();
      for (const std::uint32_t edge : leaving)
        mean += from[to_of(mesh, edge)];
      mean /= static_cast<float>(leaving.size());
      const float along = share * normals[v].dot(mean - from[v]);
      mesh.vertices_mm[v] = limits.allowed(v, from[v] + along * normals[v]);
    }
  });
}

}  // namespace

Mesh smooth_taubin(Mesh mesh, const SmoothOptions& options, const Run& run) {
  const HalfEdges edges(mesh);
  const SmoothLimits limits(mesh, edges, options);
  const std::vector<Eigen::Vector3f> normals = vertex_normals(mesh);
  for (int i = 0; i < options.iterations; ++i) {
    step(mesh, edges, limits, normals, kShrink);
    step(mesh, edges, limits, normals, kSwell);
    run.report((i + 1.0) / options.iterations);
  }
  mark_moved(mesh, limits.begin_mm());
  renew_normals(mesh);
  return mesh;
}

}  // namespace frangia
