#include "frangia/mesh/internal/smooth_limits.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "frangia/core/error.h"
#include "frangia/geometry/vertex_data.h"

namespace frangia {
namespace {

constexpr double kSharpCosine = 0.8;  // an edge is sharp above a dihedral angle of 37 degrees
// Fractions of the limit. Sharp edges are shape rather than noise, and vertices beside them often
// belong to the edge. `./run figures` measures what smoothing does to the edges of the block.
constexpr float kAtEdges = 0.15F;
constexpr float kBesideEdges = 0.4F;

/// The fraction of its limit that each vertex may move by: smaller at and beside sharp edges.
std::vector<float> limit_shares(const Mesh& mesh, const HalfEdges& edges) {
  std::vector<Eigen::Vector3f> normals;
  normals.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3f& p = mesh.vertices_mm[a];
    normals.push_back((mesh.vertices_mm[b] - p).cross(mesh.vertices_mm[c] - p).stableNormalized());
  }
  std::vector<float> shares(mesh.vertices_mm.size(), 1.0F);
  for (std::uint32_t edge = 0; edge < edges.count(); ++edge) {
    if (!edges.has_twin(edge)) continue;
    const float cosine = normals[edge / 3].dot(normals[edges.twin(edge) / 3]);
    if (!(static_cast<double>(cosine) < kSharpCosine)) continue;
    shares[source_vertex(mesh, edge)] = kAtEdges;
    shares[target_vertex(mesh, edge)] = kAtEdges;
  }
  for (const Mesh::Triangle& triangle : mesh.triangles) {
    const bool beside = std::any_of(
        triangle.begin(), triangle.end(), [&](std::uint32_t v) { return shares[v] == kAtEdges; });
    for (const std::uint32_t vertex : triangle)
      if (beside) shares[vertex] = std::min(shares[vertex], kBesideEdges);
  }
  return shares;
}

}  // namespace

SmoothLimits::SmoothLimits(const Mesh& mesh, const HalfEdges& edges, const SmoothOptions& options)
    : initial_mm_(mesh.vertices_mm), movable_(mesh.vertices_mm.size(), 1) {
  require(options.iterations >= 0 && options.max_sigmas >= 0.0,
          "the iterations and sigmas of smoothing must not be negative");
  if (!options.only.empty()) {
    require(options.only.size() == mesh.triangles.size(),
            "smoothing needs one selection flag per triangle");
    movable_.assign(movable_.size(), 0);
    for (std::size_t i = 0; i < options.only.size(); ++i) {
      for (const std::uint32_t vertex : mesh.triangles[i])
        if (options.only[i] != 0) movable_[vertex] = 1;
    }
  }
  for (std::uint32_t edge = 0; edge < edges.count(); ++edge) {
    if (edges.has_twin(edge)) continue;
    movable_[source_vertex(mesh, edge)] = 0;
    movable_[target_vertex(mesh, edge)] = 0;
  }
  if (options.max_sigmas == 0.0) return;
  if (mesh.sigma_mm.empty()) return;
  const std::vector<float> shares = limit_shares(mesh, edges);
  const std::vector<float>& noise_mm = noise_mm_of(mesh);
  for (std::size_t v = 0; v < noise_mm.size(); ++v) {
    const float sigma = noise_mm[v];
    const bool known = std::isfinite(sigma) && sigma > 0.0F;
    max_move_mm_.push_back(known ? shares[v] * static_cast<float>(options.max_sigmas) * sigma
                                 : 0.0F);
  }
}

Eigen::Vector3f SmoothLimits::allowed(std::size_t vertex, const Eigen::Vector3f& wanted) const {
  if (max_move_mm_.empty()) return wanted;
  const Eigen::Vector3f displacement = wanted - initial_mm_[vertex];
  const float length = displacement.norm();
  if (length <= max_move_mm_[vertex]) return wanted;
  return initial_mm_[vertex] + displacement * (max_move_mm_[vertex] / length);
}

}  // namespace frangia
