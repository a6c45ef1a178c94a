#include "frangia/mesh/internal/smooth.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/error.h"
#include "frangia/core/parallel.h"
#include "frangia/geometry/connectivity.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/mesh/smooth.h"

namespace frangia {
namespace {

constexpr double kSharpCosine = 0.8;  // an edge is sharp above a dihedral angle of 37 degrees
// Fractions of the limit. Sharp edges are shape rather than noise, and vertices next to them often
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
  require(options.iterations <= kMostSmoothIterations,
          "smoothing takes at most 10 000 iterations; choose fewer");
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

namespace {

using Eigen::Vector3f;

constexpr std::size_t kFacesPerChunk = 8192;
constexpr int kVertexUpdates = 15;  // Sun et al. 2007 use 10 to 20

/// Per-triangle data of the filter.
struct Faces {
  std::vector<Vector3f> centroids;
  std::vector<Vector3f> normals;  ///< unit, or zero without area
  std::vector<float> areas;
};

Faces faces_of(const Mesh& mesh) {
  Faces faces;
  const std::size_t count = mesh.triangles.size();
  faces.centroids.resize(count);
  faces.normals.resize(count);
  faces.areas.resize(count);
  parallel_chunks(count, kFacesPerChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto& [ia, ib, ic] = mesh.triangles[i];
      const Vector3f& a = mesh.vertices_mm[ia];
      const Vector3f& b = mesh.vertices_mm[ib];
      const Vector3f& c = mesh.vertices_mm[ic];
      const Vector3f cross = (b - a).cross(c - a);
      faces.centroids[i] = (a + b + c) / 3.0F;
      faces.areas[i] = 0.5F * cross.norm();
      faces.normals[i] = cross.stableNormalized();
    }
  });
  return faces;
}

/// The mean distance between the centroids of adjacent triangles: the spatial width of the filter.
float mean_spacing(const HalfEdges& edges, const Faces& faces) {
  double sum = 0.0;
  std::size_t count = 0;
  for (std::uint32_t edge = 0; edge < edges.count(); ++edge) {
    if (!edges.has_twin(edge)) continue;
    sum += static_cast<double>(
        (faces.centroids[edge / 3] - faces.centroids[edges.twin(edge) / 3]).norm());
    ++count;
  }
  return count == 0 ? 1.0F : static_cast<float>(sum / static_cast<double>(count));
}

/// Widths of the Gaussian weights.
struct FilterWidths {
  float distance_mm;
  float normal;  ///< of the difference of two unit normals
};

/// Filters the normals over the triangles that share a vertex.
std::vector<Vector3f> filtered_normals(const Mesh& mesh,
                                       const HalfEdges& edges,
                                       const Faces& faces,
                                       const FilterWidths& widths) {
  std::vector<Vector3f> result(faces.normals.size());
  const float per_distance = 0.5F / (widths.distance_mm * widths.distance_mm);
  const float per_normal = 0.5F / (widths.normal * widths.normal);
  parallel_chunks(result.size(), kFacesPerChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Vector3f sum = Vector3f::Zero();
      for (const std::uint32_t vertex : mesh.triangles[i]) {
        for (const std::uint32_t edge : edges.outgoing(vertex)) {
          const std::size_t other = edge / 3;
          const float squared_distance =
              (faces.centroids[other] - faces.centroids[i]).squaredNorm();
          const float squared_difference = (faces.normals[other] - faces.normals[i]).squaredNorm();
          sum += faces.areas[other] *
                 std::exp(-squared_distance * per_distance - squared_difference * per_normal) *
                 faces.normals[other];
        }
      }
      const Vector3f unit = sum.stableNormalized();
      result[i] = unit.allFinite() ? unit : faces.normals[i];
    }
  });
  return result;
}

/// Moves each vertex to the mean of its projections on the planes through the triangle centroids.
void update_vertices(Mesh& mesh,
                     const HalfEdges& edges,
                     const std::vector<Vector3f>& normals,
                     const SmoothLimits& limits) {
  const std::vector<Vector3f> from = mesh.vertices_mm;
  parallel_chunks(from.size(), kFacesPerChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const auto outgoing = edges.outgoing(static_cast<std::uint32_t>(v));
      if (!limits.may_move(v) || outgoing.empty()) continue;
      Vector3f displacement = Vector3f::Zero();
      for (const std::uint32_t edge : outgoing) {
        const auto& [a, b, c] = mesh.triangles[edge / 3];
        const Vector3f centroid = (from[a] + from[b] + from[c]) / 3.0F;
        displacement += normals[edge / 3] * normals[edge / 3].dot(centroid - from[v]);
      }
      const Vector3f wanted = from[v] + displacement / static_cast<float>(outgoing.size());
      mesh.vertices_mm[v] = limits.allowed(v, wanted);
    }
  });
}

}  // namespace

Mesh smooth_keeping_edges(Mesh mesh, const KeepEdgesOptions& options, const Run& run) {
  require(options.crease_rad > 0.0, "the crease angle of smoothing must be positive");
  run.check();
  const HalfEdges edges(mesh);
  const SmoothLimits limits(mesh, edges, options.smooth);
  Faces faces = faces_of(mesh);
  const FilterWidths widths{.distance_mm = mean_spacing(edges, faces),
                            .normal = static_cast<float>(options.crease_rad)};
  for (int i = 0; i < options.smooth.iterations; ++i) {
    faces.normals = filtered_normals(mesh, edges, faces, widths);
    run.report(0.7 * (i + 1.0) / options.smooth.iterations);
  }
  for (int i = 0; i < kVertexUpdates && options.smooth.iterations > 0; ++i) {
    update_vertices(mesh, edges, faces.normals, limits);
    run.report(0.7 + 0.3 * (i + 1.0) / kVertexUpdates);
  }
  mark_displaced(mesh, limits.initial_mm());
  recompute_normals(mesh);
  return mesh;
}

}  // namespace frangia
