#include "frangia/inspect/surface_error.h"

#include <algorithm>
#include <cmath>

#include "frangia/core/interruptible_chunks.h"
#include "frangia/geometry/sample_surface.h"

namespace frangia {
namespace {

std::vector<float> signed_distances(const std::vector<Eigen::Vector3d>& points,
                                    const RayScene& reference,
                                    const ExactSurface* exact,
                                    const Run& run) {
  require(!reference.mesh().empty(),
          "the reference has no triangles, only points; give a mesh with triangles");
  constexpr std::size_t kChunk = 2048;
  constexpr std::size_t kBlock = 64 * kChunk;  // between reports of progress
  std::vector<float> distances(points.size());
  for (std::size_t done = 0; done < points.size(); done += kBlock) {
    const std::size_t size = std::min(kBlock, points.size() - done);
    interruptible_chunks(size, kChunk, run, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = done + begin; i < done + end; ++i) {
        const NearestPoint near = *reference.nearest(points[i]);
        const double distance = exact == nullptr
                                    ? near.signed_distance_mm
                                    : exact->nearest(points[i], near).signed_distance_mm;
        distances[i] = static_cast<float>(distance);
      }
    });
    run.report(static_cast<double>(done + size) / static_cast<double>(points.size()));
  }
  return distances;
}

std::vector<Eigen::Vector3d> points_of(const Mesh& mesh, const SurfaceErrorOptions& options) {
  std::vector<Eigen::Vector3d> points;
  if (options.samples > 0) {
    for (const SurfaceSample& sample : sample_surface(mesh, options.samples, options.seed)) {
      points.push_back(sample.point_mm);
    }
    return points;
  }
  std::vector<bool> used(mesh.vertices_mm.size(), false);
  for (const auto& triangle : mesh.triangles) {
    for (const auto vertex : triangle)
      used[vertex] = true;
  }
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i]) points.emplace_back(mesh.vertices_mm[i].cast<double>());
  }
  return points;
}

/// The smallest value that at least this share of the sorted values does not exceed.
double percentile(const std::vector<float>& sorted, double share) {
  const double rank = std::ceil(share * static_cast<double>(sorted.size())) - 1.0;
  return static_cast<double>(sorted[static_cast<std::size_t>(std::max(rank, 0.0))]);
}

}  // namespace

SurfaceError surface_error(const Mesh& mesh,
                           const RayScene& reference,
                           const SurfaceErrorOptions& options,
                           const Run& run) {
  const std::vector<Eigen::Vector3d> points = points_of(mesh, options);
  require(!points.empty(), "the mesh has no triangles, only points; give a mesh with triangles");
  std::vector<float> distances = signed_distances(points, reference, options.exact, run);

  SurfaceError error;
  error.count = distances.size();
  double sum2 = 0.0;
  double sum2_within = 0.0;
  std::size_t within = 0;
  for (float& distance : distances) {
    const auto d = static_cast<double>(distance);
    error.bias_mm += d;
    error.mean_mm += std::abs(d);
    sum2 += d * d;
    if (std::abs(d) <= options.max_distance_mm) {
      sum2_within += d * d;
      ++within;
    }
    distance = std::abs(distance);
  }
  const auto count = static_cast<double>(error.count);
  error.bias_mm /= count;
  error.mean_mm /= count;
  error.rms_mm = std::sqrt(sum2 / count);
  error.rms_within_mm = within > 0 ? std::sqrt(sum2_within / static_cast<double>(within)) : 0.0;
  error.share_beyond = 1.0 - static_cast<double>(within) / count;
  std::sort(distances.begin(), distances.end());
  error.p95_mm = percentile(distances, 0.95);
  error.p99_mm = percentile(distances, 0.99);
  error.max_mm = static_cast<double>(distances.back());
  return error;
}

std::vector<float> vertex_errors_mm(const Mesh& mesh,
                                    const RayScene& reference,
                                    const Run& run,
                                    const ExactSurface* exact) {
  std::vector<Eigen::Vector3d> points;
  points.reserve(mesh.vertices_mm.size());
  for (const auto& vertex : mesh.vertices_mm)
    points.emplace_back(vertex.cast<double>());
  return signed_distances(points, reference, exact, run);
}

}  // namespace frangia
