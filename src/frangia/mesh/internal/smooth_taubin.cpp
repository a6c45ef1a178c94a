#include <vector>

#include "frangia/core/parallel.h"
#include "frangia/geometry/half_edges.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/mesh/internal/smooth_limits.h"
#include "frangia/mesh/smooth.h"

namespace frangia {
namespace {

constexpr std::size_t kVerticesPerChunk = 8192;
// Taubin's lambda and mu: the pass-band frequency 1/lambda + 1/mu = 0.04 keeps shapes larger than
// about thirty edges.
constexpr float kShrink = 0.5F;
constexpr float kInflate = -0.51F;

/// Moves each vertex by a share of the way to the mean of its neighbours, along its normal only:
/// noise has no tangential part, and tangential drift would use up the limit.
void filter_step(Mesh& mesh,
                 const HalfEdges& edges,
                 const SmoothLimits& limits,
                 const std::vector<Eigen::Vector3f>& normals,
                 float share) {
  const std::vector<Eigen::Vector3f> from = mesh.vertices_mm;
  parallel_chunks(from.size(), kVerticesPerChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const auto outgoing = edges.outgoing(static_cast<std::uint32_t>(v));
      if (!limits.may_move(v) || outgoing.empty()) continue;
      Eigen::Vector3f mean = Eigen::Vector3f::Zero();
      for (const std::uint32_t edge : outgoing)
        mean += from[target_vertex(mesh, edge)];
      mean /= static_cast<float>(outgoing.size());
      const float along = share * normals[v].dot(mean - from[v]);
      mesh.vertices_mm[v] = limits.allowed(v, from[v] + along * normals[v]);
    }
  });
}

}  // namespace

Mesh smooth_taubin(Mesh mesh, const SmoothOptions& options, const Run& run) {
  run.check();
  const HalfEdges edges(mesh);
  const SmoothLimits limits(mesh, edges, options);
  const std::vector<Eigen::Vector3f> normals = vertex_normals(mesh);
  for (int i = 0; i < options.iterations; ++i) {
    filter_step(mesh, edges, limits, normals, kShrink);
    filter_step(mesh, edges, limits, normals, kInflate);
    run.report((i + 1.0) / options.iterations);
  }
  mark_displaced(mesh, limits.initial_mm());
  recompute_normals(mesh);
  return mesh;
}

}  // namespace frangia
