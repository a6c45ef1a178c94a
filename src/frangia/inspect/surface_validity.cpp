#include "frangia/inspect/surface_validity.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/parallel.h"
#include "frangia/inspect/surface_error.h"
#include "frangia/mesh/make_manifold.h"

namespace frangia {
namespace {

double sigma_ratio(const Mesh& mesh,
                   const RayScene& reference,
                   const Run& run,
                   const ExactSurface* exact) {
  if (mesh.sigma_mm.empty()) return kMissing;
  const std::vector<float> errors = vertex_errors_mm(mesh, reference, run, exact);
  double squares = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const auto ratio = static_cast<double>(errors[i]) / static_cast<double>(mesh.sigma_mm[i]);
    if (!std::isfinite(ratio)) continue;
    squares += ratio * ratio;
    ++count;
  }
  return count > 0 ? std::sqrt(squares / static_cast<double>(count)) : kMissing;
}

/// Whether the normal of a triangle opposes that of the reference at the nearest point: by more
/// than 135 degrees, which a triangle that rounds off an edge does not reach.
bool is_inward(const Mesh& mesh, const Mesh::Triangle& triangle, const RayScene& reference) {
  const Eigen::Vector3d a = mesh.vertices_mm[triangle[0]].cast<double>();
  const Eigen::Vector3d b = mesh.vertices_mm[triangle[1]].cast<double>();
  const Eigen::Vector3d c = mesh.vertices_mm[triangle[2]].cast<double>();
  const Eigen::Vector3d normal = (b - a).cross(c - a);
  const auto nearest = reference.nearest((a + b + c) / 3.0);
  if (!(normal.norm() > 0.0) || !nearest) return false;
  const auto& corners = reference.mesh().triangles[nearest->triangle];
  const Eigen::Vector3d origin = reference.mesh().vertices_mm[corners[0]].cast<double>();
  const Eigen::Vector3d outward =
      (reference.mesh().vertices_mm[corners[1]].cast<double>() - origin)
          .cross(reference.mesh().vertices_mm[corners[2]].cast<double>() - origin);
  constexpr double kMaxInwardCosine = -0.7;  // cos 135 deg
  return normal.normalized().dot(outward.normalized()) < kMaxInwardCosine;
}

}  // namespace

SurfaceValidity surface_validity(const Mesh& mesh,
                                 const RayScene& reference,
                                 const Run& run,
                                 const ExactSurface* exact) {
  std::vector<std::uint8_t> inward(mesh.triangles.size());
  interruptible_chunks(inward.size(), 1024, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      inward[i] = is_inward(mesh, mesh.triangles[i], reference) ? 1 : 0;
  });
  return {sigma_ratio(mesh, reference, run, exact),
          count_non_manifold_edges(mesh),
          static_cast<std::size_t>(std::count(inward.begin(), inward.end(), 1))};
}

}  // namespace frangia
