#include "frangia/mesh/remove_spikes.h"

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/parallel.h"
#include "frangia/mesh/half_edges.h"
#include "frangia/mesh/vertex_data.h"

namespace frangia {
namespace {

using Eigen::Vector3f;

/// Where the tip of a spike belongs; nothing for a vertex that is none.
std::optional<Vector3f> place_of_tip(const Mesh& mesh,
                                     const HalfEdges& edges,
                                     std::uint32_t vertex,
                                     float below_rad) {
  const auto leaving = edges.leaving(vertex);
  if (leaving.size() < 3) return std::nullopt;
  const Vector3f& here = mesh.vertices_mm[vertex];
  float angles = 0.0F;
  Vector3f mean = Vector3f::Zero();
  for (const std::uint32_t edge : leaving) {
    if (!edges.has_twin(edge) || !edges.has_twin(HalfEdges::before(edge))) return std::nullopt;
    const Vector3f next = mesh.vertices_mm[to_of(mesh, edge)] - here;
    const Vector3f last = mesh.vertices_mm[across_of(mesh, edge)] - here;
    angles += std::atan2(next.cross(last).norm(), next.dot(last));
    mean += mesh.vertices_mm[to_of(mesh, edge)];
  }
  if (!(angles < below_rad)) return std::nullopt;
  return mean / static_cast<float>(leaving.size());
}

}  // namespace

Mesh remove_spikes(Mesh mesh, const RemoveSpikesOptions& options, const Run& run) {
  constexpr std::size_t kChunk = 8192;
  const HalfEdges edges(mesh);
  const std::vector<Vector3f> before = mesh.vertices_mm;
  const auto below = static_cast<float>(options.below_rad);
  for (int round = 0; round < options.rounds; ++round) {
    std::vector<std::optional<Vector3f>> places(mesh.vertices_mm.size());
    parallel_chunks(places.size(), kChunk, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v)
        places[v] = place_of_tip(mesh, edges, static_cast<std::uint32_t>(v), below);
    });
    bool any = false;
    for (std::size_t v = 0; v < places.size(); ++v) {
      if (!places[v]) continue;
      mesh.vertices_mm[v] = *places[v];
      any = true;
    }
    if (!any) break;
    run.report((round + 1.0) / options.rounds);
  }
  mark_moved(mesh, before);
  renew_normals(mesh);
  return mesh;
}

}  // namespace frangia
