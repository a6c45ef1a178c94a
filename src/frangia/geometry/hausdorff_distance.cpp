#include "frangia/geometry/hausdorff_distance.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "frangia/core/error.h"
#include "frangia/core/parallel.h"
#include "frangia/geometry/surface_samples.h"

namespace frangia {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kTrianglesPerChunk = 1024;

/// Returns the largest distance of the samples of one surface from the other one.
double largest_distance(const Mesh& from, const RayScene& to, double spacing_mm, const Run& run) {
  const std::size_t count = from.triangles.size();
  std::vector<double> largest((count + kTrianglesPerChunk - 1) / kTrianglesPerChunk);
  parallel_chunks(count, kTrianglesPerChunk, [&](std::size_t begin, std::size_t end) {
    double& most = largest[begin / kTrianglesPerChunk];
    for (std::size_t t = begin; t < end; ++t) {
      const auto& [a, b, c] = from.triangles[t];
      static_cast<void>(all_triangle_samples(from.vertices_mm[a].cast<double>(),
                                             from.vertices_mm[b].cast<double>(),
                                             from.vertices_mm[c].cast<double>(),
                                             spacing_mm,
                                             [&](const Vector3d& point) {
                                               const auto near = to.nearest(point);
                                               if (near) most = std::max(most, near->distance_mm);
                                               return true;
                                             }));
    }
  });
  run.check();
  return *std::max_element(largest.begin(), largest.end());
}

}  // namespace

double mean_edge_length_mm(const Mesh& mesh) {
  double sum = 0.0;
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      sum += static_cast<double>(
          (mesh.vertices_mm[triangle[i]] - mesh.vertices_mm[triangle[(i + 1) % 3]]).norm());
    }
  }
  return mesh.empty() ? 0.0 : sum / (3.0 * static_cast<double>(mesh.triangles.size()));
}

double hausdorff_distance_mm(const RayScene& a,
                             const RayScene& b,
                             double spacing_mm,
                             const Run& run) {
  require(!a.mesh().empty() && !b.mesh().empty(), "hausdorff_distance: a mesh has no triangle");
  require(spacing_mm > 0.0, "hausdorff_distance: the spacing must be positive");
  return std::max(largest_distance(a.mesh(), b, spacing_mm, run),
                  largest_distance(b.mesh(), a, spacing_mm, run));
}

}  // namespace frangia
