#include "frangia/geometry/surface_extent.h"

#include <cmath>
#include <vector>

#include "frangia/core/error.h"
#include "frangia/geometry/boundary.h"
#include "frangia/geometry/internal/triangle_area.h"
#include "frangia/geometry/vertex_data.h"

namespace frangia {
namespace {

using Eigen::Vector3d;
using Gradients = std::vector<Vector3d>;

/// u^2 = sum (g_i . n_i noise_i)^2 + (sum g_i . n_i systematic_i)^2, with the gradient g_i of the
/// value by the place of vertex i.
double propagated(const Mesh& mesh, const Gradients& gradients) {
  if (mesh.sigma_mm.empty()) return kMissing;
  const MedianSigma median = median_sigma(mesh);
  const bool has_parts = !mesh.sigma_systematic_mm.empty();
  const double usual = has_parts ? median.noise_mm : median.combined_mm;
  if (!std::isfinite(usual)) return kMissing;
  const auto known = [](float value, double otherwise) {
    return std::isfinite(value) ? static_cast<double>(value) : otherwise;
  };
  const std::vector<float>& noise = noise_mm_of(mesh);
  const auto normals = vertex_normals(mesh);
  double independent = 0.0;
  double alike = 0.0;
  for (std::size_t i = 0; i < gradients.size(); ++i) {
    const double along = gradients[i].dot(normals[i].cast<double>());
    const double moved = along * known(noise[i], usual);
    independent += moved * moved;
    if (has_parts) alike += along * known(mesh.sigma_systematic_mm[i], median.systematic_mm);
  }
  return std::sqrt(independent + alike * alike);
}

}  // namespace

SurfaceExtent area_of(const Mesh& mesh, const Selection& selection) {
  require(selection.empty() || selection.size() == mesh.triangles.size(),
          "area_of: the selection must have one flag for each triangle");
  const bool all = count_selected(selection) == 0;
  SurfaceExtent area;
  Gradients gradients(mesh.vertices_mm.size(), Vector3d::Zero());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!all && selection[t] == 0) continue;
    const Vector3d doubled = doubled_area_vector(mesh, t);
    const double size = doubled.norm();
    if (!(size > 0.0)) continue;
    area.value += 0.5 * size;
    for (std::size_t k = 0; k < 3; ++k)
      area.center_mm += size / 6.0 * corner_mm(mesh, t, k);
    const Vector3d normal = doubled / size;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3d opposite = corner_mm(mesh, t, (k + 2) % 3) - corner_mm(mesh, t, (k + 1) % 3);
      gradients[mesh.triangles[t].at(k)] += 0.5 * normal.cross(opposite);
    }
  }
  if (area.value > 0.0) area.center_mm /= area.value;
  area.u = propagated(mesh, gradients);
  return area;
}

SurfaceExtent volume_of(const Mesh& mesh) {
  require(!mesh.empty(), "the surface has no triangle, so it has no volume");
  require(boundary_loops(mesh).empty(),
          "a volume needs a closed surface, and this one has a hole; fill the holes first");
  const Vector3d origin = corner_mm(mesh, 0, 0);  // keeps the digits far from zero
  SurfaceExtent volume;
  Gradients gradients(mesh.vertices_mm.size(), Vector3d::Zero());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vector3d doubled = doubled_area_vector(mesh, t);
    volume.value += (corner_mm(mesh, t, 0) - origin).dot(doubled) / 6.0;
    for (const std::uint32_t vertex : mesh.triangles[t])
      gradients[vertex] += doubled / 6.0;
  }
  volume.u = propagated(mesh, gradients);
  volume.center_mm = area_of(mesh).center_mm;
  return volume;
}

}  // namespace frangia
