#include "frangia/features/feature_points.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <Eigen/Geometry>

#include "frangia/core/error.h"
#include "frangia/core/statistics.h"
#include "frangia/geometry/surface_samples.h"
#include "frangia/geometry/vertex_data.h"

namespace frangia {
namespace {

constexpr std::size_t kSamples = 120'000;  ///< of a mesh whose vertices do not cover it
/// A vertex of an even mesh represents about the square of an edge's length. Where the squared
/// length, weighted by area, exceeds the area per vertex by more, vertices do not cover the mesh.
constexpr double kEvenness = 8.0;
constexpr std::size_t kFewVertices = 400;  ///< are those of a tessellated model

/// Area, and the mean over the area of the longest edge of a triangle.
struct Extent {
  double area_mm2 = 0.0;
  double edge_mm = 0.0;
};

Extent extent_of(const Mesh& mesh) {
  Extent extent;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d p = mesh.vertices_mm[a].cast<double>();
    const Eigen::Vector3d q = mesh.vertices_mm[b].cast<double>();
    const Eigen::Vector3d r = mesh.vertices_mm[c].cast<double>();
    const double area = 0.5 * (q - p).cross(r - p).norm();
    const double edge =
        std::sqrt(std::max({(q - p).squaredNorm(), (r - q).squaredNorm(), (p - r).squaredNorm()}));
    if (!std::isfinite(area)) continue;
    extent.area_mm2 += area;
    extent.edge_mm += area * edge;
  }
  if (extent.area_mm2 > 0.0) extent.edge_mm /= extent.area_mm2;
  return extent;
}

/// The values of some vertices; those that are not finite and positive become the median.
std::vector<double> chosen_values(const std::vector<float>& values,
                                  const std::vector<std::uint32_t>& vertices) {
  std::vector<double> chosen;
  std::vector<double> known;
  chosen.reserve(vertices.size());
  for (const std::uint32_t v : vertices) {
    const auto value = static_cast<double>(values[v]);
    chosen.push_back(value);
    if (std::isfinite(value) && value > 0.0) known.push_back(value);
  }
  if (known.empty()) return {};
  const double usual = median(known);
  for (double& value : chosen)
    if (!(std::isfinite(value) && value > 0.0)) value = usual;
  return chosen;
}

/// The mean of the values of the corners of a triangle, which its points have between them.
std::vector<double> corner_means(const std::vector<float>& values,
                                 const Mesh& mesh,
                                 const std::vector<SurfaceSample>& samples) {
  std::vector<float> means;
  std::vector<std::uint32_t> all;
  for (const SurfaceSample& sample : samples) {
    const auto& [a, b, c] = mesh.triangles[sample.triangle];
    all.push_back(static_cast<std::uint32_t>(means.size()));
    means.push_back((values[a] + values[b] + values[c]) / 3.0F);
  }
  return chosen_values(means, all);
}

/// Points between the vertices of `measured`, with the sigma that `mesh` states for those.
FeaturePoints sampled(const Mesh& measured, const Mesh& mesh) {
  FeaturePoints points;
  const std::vector<SurfaceSample> samples = sample_surface(measured, kSamples);
  for (const SurfaceSample& sample : samples) {
    points.points_mm.push_back(sample.point_mm);
    points.normals.push_back(sample.normal);
  }
  if (!mesh.sigma_mm.empty()) points.noise_mm = corner_means(noise_mm_of(mesh), measured, samples);
  if (!mesh.sigma_systematic_mm.empty())
    points.systematic_mm = corner_means(mesh.sigma_systematic_mm, measured, samples);
  return points;
}

/// Takes over the displacements of the points and takes them out of their systematic parts.
void add_calibration(FeaturePoints& points, const Eigen::MatrixXf& calibration_mm) {
  const auto count = static_cast<Eigen::Index>(points.size());
  points.calibration_mm.resize(calibration_mm.rows(), count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto vertex = static_cast<Eigen::Index>(points.vertices[static_cast<std::size_t>(i)]);
    points.calibration_mm.col(i) = calibration_mm.col(vertex);
    if (points.systematic_mm.empty()) continue;
    double& rest = points.systematic_mm[static_cast<std::size_t>(i)];
    const auto known = static_cast<double>(points.calibration_mm.col(i).norm());
    rest = std::sqrt(std::max(0.0, rest * rest - known * known));
  }
}

}  // namespace

FeaturePoints feature_points_of(const Mesh& mesh,
                                const Run& run,
                                const Eigen::MatrixXf* calibration_mm) {
  Mesh measured;
  measured.vertices_mm = mesh.vertices_mm;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (mark_of(mesh, t) != Mark::Synthesized) measured.triangles.push_back(mesh.triangles[t]);
  run.check();
  const Extent extent = extent_of(measured);
  require(extent.area_mm2 > 0.0,
          "the mesh has no measured triangle with an area to find shapes in");
  std::vector<bool> used(mesh.vertices_mm.size(), false);
  std::size_t count = 0;
  for (const auto& triangle : measured.triangles) {
    for (const std::uint32_t v : triangle) {
      if (!used[v]) ++count;
      used[v] = true;
    }
  }
  FeaturePoints points;
  const bool uneven =
      extent.edge_mm * extent.edge_mm * static_cast<double>(count) > kEvenness * extent.area_mm2;
  if (uneven || count < kFewVertices) {
    points = sampled(measured, mesh);
    points.area_mm2 = extent.area_mm2;
    return points;
  }
  const std::vector<Eigen::Vector3f> normals = vertex_normals(measured);
  run.check();
  std::vector<std::uint32_t>& vertices = points.vertices;
  vertices.reserve(count);
  for (std::uint32_t v = 0; v < used.size(); ++v) {
    if (!used[v] || !mesh.vertices_mm[v].allFinite() || !(normals[v].squaredNorm() > 0.5F))
      continue;
    vertices.push_back(v);
    points.points_mm.emplace_back(mesh.vertices_mm[v].cast<double>());
    points.normals.emplace_back(normals[v].cast<double>());
  }
  if (!mesh.sigma_mm.empty()) points.noise_mm = chosen_values(noise_mm_of(mesh), vertices);
  if (!mesh.sigma_systematic_mm.empty())
    points.systematic_mm = chosen_values(mesh.sigma_systematic_mm, vertices);
  points.area_mm2 = extent.area_mm2;
  if (calibration_mm != nullptr && calibration_mm->size() > 0)
    add_calibration(points, *calibration_mm);
  return points;
}

}  // namespace frangia
