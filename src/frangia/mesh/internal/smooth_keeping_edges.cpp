#include <cmath>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/error.h"
#include "frangia/core/parallel.h"
#include "frangia/geometry/half_edges.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/mesh/internal/smooth_limits.h"
#include "frangia/mesh/smooth.h"

namespace frangia {
namespace {

using Eigen::Vector3f;

constexpr std::size_t kChunk = 8192;
constexpr int kFollowingSteps = 15;  // of the vertices after the directions

/// What smoothing knows of each triangle.
struct Faces {
  std::vector<Vector3f> centers;
  std::vector<Vector3f> normals;  ///< unit, or zero without area
  std::vector<float> areas;
};

Faces faces_of(const Mesh& mesh) {
  Faces faces;
  const std::size_t count = mesh.triangles.size();
  faces.centers.resize(count);
  faces.normals.resize(count);
  faces.areas.resize(count);
  parallel_chunks(count, kChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto& [ia, ib, ic] = mesh.triangles[i];
      const Vector3f& a = mesh.vertices_mm[ia];
      const Vector3f& b = mesh.vertices_mm[ib];
      const Vector3f& c = mesh.vertices_mm[ic];
      const Vector3f cross = (b - a).cross(c - a);
      faces.centers[i] = (a + b + c) / 3.0F;
      faces.areas[i] = 0.5F * cross.norm();
      faces.normals[i] = cross.stableNormalized();
    }
  });
  return faces;
}

/// The mean distance between neighbouring triangles' centres: the reach of the averaging.
float mean_spacing(const Mesh& mesh, const HalfEdges& edges, const Faces& faces) {
  double sum = 0.0;
  std::size_t count = 0;
  for (std::uint32_t edge = 0; edge < edges.count(); ++edge) {
    if (!edges.has_twin(edge)) continue;
    sum +=
        static_cast<double>((faces.centers[edge / 3] - faces.centers[edges.twin(edge) / 3]).norm());
    ++count;
  }
  static_cast<void>(mesh);
  return count == 0 ? 1.0F : static_cast<float>(sum / static_cast<double>(count));
}

struct Widths {
  float place_mm;
  float direction;
};

/// The directions averaged with those of the triangles at the same vertices.
std::vector<Vector3f> averaged(const Mesh& mesh,
                               const HalfEdges& edges,
                               const Faces& faces,
                               const Widths& widths) {
  std::vector<Vector3f> result(faces.normals.size());
  const float per_place = 0.5F / (widths.place_mm * widths.place_mm);
  const float per_direction = 0.5F / (widths.direction * widths.direction);
  parallel_chunks(result.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Vector3f sum = Vector3f::Zero();
      for (const std::uint32_t vertex : mesh.triangles[i]) {
        for (const std::uint32_t edge : edges.outgoing(vertex)) {
          const std::size_t other = edge / 3;
          const float apart = (faces.centers[other] - faces.centers[i]).squaredNorm();
          const float turned = (faces.normals[other] - faces.normals[i]).squaredNorm();
          sum += faces.areas[other] * std::exp(-apart * per_place - turned * per_direction) *
                 faces.normals[other];
        }
      }
      const Vector3f unit = sum.stableNormalized();
      result[i] = unit.allFinite() ? unit : faces.normals[i];
    }
  });
  return result;
}

/// Each vertex goes onto the mean of the planes through its triangles' centres.
void follow(Mesh& mesh,
            const HalfEdges& edges,
            const std::vector<Vector3f>& normals,
            const SmoothLimits& limits) {
  const std::vector<Vector3f> from = mesh.vertices_mm;
  parallel_chunks(from.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const auto outgoing = edges.outgoing(static_cast<std::uint32_t>(v));
      if (!limits.may_move(v) || outgoing.empty()) continue;
      Vector3f way = Vector3f::Zero();
      for (const std::uint32_t edge : outgoing) {
        const auto& [a, b, c] = mesh.triangles[edge / 3];
        const Vector3f center = (from[a] + from[b] + from[c]) / 3.0F;
        way += normals[edge / 3] * normals[edge / 3].dot(center - from[v]);
      }
      const Vector3f wanted = from[v] + way / static_cast<float>(outgoing.size());
      mesh.vertices_mm[v] = limits.allowed(v, wanted);
    }
  });
}

}  // namespace

Mesh smooth_keeping_edges(Mesh mesh, const KeepEdgesOptions& options, const Run& run) {
  require(options.crease_rad > 0.0, "smooth: the angle of an edge must be positive");
  const HalfEdges edges(mesh);
  const SmoothLimits limits(mesh, edges, options.smooth);
  Faces faces = faces_of(mesh);
  const Widths widths{.place_mm = mean_spacing(mesh, edges, faces),
                      .direction = static_cast<float>(options.crease_rad)};
  for (int i = 0; i < options.smooth.iterations; ++i) {
    faces.normals = averaged(mesh, edges, faces, widths);
    run.report(0.7 * (i + 1.0) / options.smooth.iterations);
  }
  for (int i = 0; i < kFollowingSteps && options.smooth.iterations > 0; ++i) {
    follow(mesh, edges, faces.normals, limits);
    run.report(0.7 + 0.3 * (i + 1.0) / kFollowingSteps);
  }
  mark_displaced(mesh, limits.initial_mm());
  recompute_normals(mesh);
  return mesh;
}

}  // namespace frangia
