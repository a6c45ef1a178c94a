#include "frangia/mesh/remove_spikes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/parallel.h"
#include "frangia/geometry/connectivity.h"
#include "frangia/geometry/hausdorff_distance.h"
#include "frangia/geometry/vertex_data.h"

namespace frangia {
namespace {

using Eigen::Vector3f;

/// The mean of the neighbours of a spike's tip; nullopt for a vertex that is not a tip.
std::optional<Vector3f> tip_target(const Mesh& mesh,
                                   const HalfEdges& edges,
                                   std::uint32_t vertex,
                                   float below_rad) {
  const auto outgoing = edges.outgoing(vertex);
  if (outgoing.size() < 3) return std::nullopt;
  const Vector3f& here = mesh.vertices_mm[vertex];
  float angles = 0.0F;
  Vector3f mean = Vector3f::Zero();
  for (const std::uint32_t edge : outgoing) {
    if (!edges.has_twin(edge) || !edges.has_twin(HalfEdges::previous(edge))) return std::nullopt;
    const Vector3f next = mesh.vertices_mm[target_vertex(mesh, edge)] - here;
    const Vector3f last = mesh.vertices_mm[opposite_vertex(mesh, edge)] - here;
    angles += std::atan2(next.cross(last).norm(), next.dot(last));
    mean += mesh.vertices_mm[target_vertex(mesh, edge)];
  }
  if (!(angles < below_rad)) return std::nullopt;
  return mean / static_cast<float>(outgoing.size());
}

/// Whether a boundary vertex is the tip of a needle, such as a flying pixel of a scanner.
bool is_needle(const Mesh& mesh,
               const HalfEdges& edges,
               std::uint32_t vertex,
               float below_rad,
               float shortest_mm) {
  bool at_boundary = false;
  float angles = 0.0F;
  for (const std::uint32_t edge : edges.outgoing(vertex)) {
    at_boundary =
        at_boundary || edges.is_boundary(edge) || edges.is_boundary(HalfEdges::previous(edge));
    const Vector3f next = mesh.vertices_mm[target_vertex(mesh, edge)] - mesh.vertices_mm[vertex];
    const Vector3f last = mesh.vertices_mm[opposite_vertex(mesh, edge)] - mesh.vertices_mm[vertex];
    if (std::min(next.norm(), last.norm()) < shortest_mm) return false;
    angles += std::atan2(next.cross(last).norm(), next.dot(last));
  }
  return at_boundary && angles < below_rad;
}

/// Removes the triangles at the tips of needles: the data does not show where the surface ends
/// without them. Returns the half-edges of the remaining mesh.
HalfEdges remove_needles(Mesh& mesh, const RemoveSpikesOptions& options, const Run& run) {
  // A tip on a boundary has only part of the angles of a full spike: 15 instead of 180 degrees
  // keeps the corners of regular meshes (45 degrees and more).
  constexpr float kAngleShare = 1.0F / 12.0F;
  constexpr float kLengthShare = 2.0F;  // of the mean edge: shorter edges are the mesh's own
  const float below_rad = kAngleShare * static_cast<float>(options.below_rad);
  const float shortest_mm = kLengthShare * static_cast<float>(mean_edge_length_mm(mesh));
  for (int round = 0;; ++round) {
    run.check();
    HalfEdges edges(mesh);
    std::vector<std::uint8_t> keep(mesh.triangles.size(), 1);
    for (std::uint32_t v = 0; v < mesh.vertices_mm.size(); ++v) {
      if (!is_needle(mesh, edges, v, below_rad, shortest_mm)) continue;
      for (const std::uint32_t edge : edges.outgoing(v))
        keep[edge / 3] = 0;
    }
    const bool none = std::find(keep.begin(), keep.end(), 0) == keep.end();
    if (none || round == options.iterations) return edges;
    keep_triangles(mesh, keep);
  }
}

}  // namespace

Mesh remove_spikes(Mesh mesh, const RemoveSpikesOptions& options, const Run& run) {
  constexpr std::size_t kChunk = 8192;
  const HalfEdges edges = remove_needles(mesh, options, run);
  const std::vector<Vector3f> before = mesh.vertices_mm;
  const auto below = static_cast<float>(options.below_rad);
  for (int round = 0; round < options.iterations; ++round) {
    std::vector<std::optional<Vector3f>> positions(mesh.vertices_mm.size());
    parallel_chunks(positions.size(), kChunk, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v)
        positions[v] = tip_target(mesh, edges, static_cast<std::uint32_t>(v), below);
    });
    run.check();
    bool any = false;
    for (std::size_t v = 0; v < positions.size(); ++v) {
      if (!positions[v]) continue;
      mesh.vertices_mm[v] = *positions[v];
      any = true;
    }
    if (!any) break;
    run.report((round + 1.0) / options.iterations);
  }
  mark_displaced(mesh, before);
  recompute_normals(mesh);
  return mesh;
}

}  // namespace frangia
