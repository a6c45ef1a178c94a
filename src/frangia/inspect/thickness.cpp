#include "frangia/inspect/thickness.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <Eigen/Geometry>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/parallel.h"
#include "frangia/core/statistics.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/inspect/internal/vertex_use.h"

namespace frangia {
namespace {

/// What counts as the opposite wall.
struct ThicknessLimits {
  double max_tilt_rad = rad_from_deg(45.0);  ///< between the normals of the two walls
  /// Largest angle between the normal of a vertex and those of its triangles: 45 degrees at the
  /// edge of a box, 15 on a cylinder of 12 facets.
  double max_edge_rad = rad_from_deg(30.0);
};
constexpr ThicknessLimits kWallLimits;

using Eigen::Vector3d;

ThicknessStatus thickness_status_of(VertexUse use) {
  switch (use) {
    case VertexUse::Measured:
      return ThicknessStatus::Measured;
    case VertexUse::Synthesized:
      return ThicknessStatus::Synthesized;
    case VertexUse::MeshEdge:
      return ThicknessStatus::MeshEdge;
    case VertexUse::Unused:
      break;
  }
  return ThicknessStatus::Unused;
}

/// A value of the vertices at a point of a triangle.
double value_at(const Mesh& mesh, const std::vector<float>& values, const RayHit& hit) {
  const Mesh::Triangle& corners = mesh.triangles[hit.triangle];
  double value = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    value +=
        hit.barycentric[static_cast<Eigen::Index>(k)] * static_cast<double>(values[corners.at(k)]);
  }
  return value;
}

/// Measures the walls of one mesh.
class WallFinder {
 public:
  explicit WallFinder(const RayScene& scene)
      : scene_(scene), normals_(vertex_normals(scene.mesh())) {
    Eigen::AlignedBox3d box;
    for (const auto& vertex : scene.mesh().vertices_mm)
      if (vertex.allFinite()) box.extend(vertex.cast<double>());
    start_mm_ = 1e-6 * box.diagonal().norm();  // the rounding of vertices in single precision
  }

  void measure(std::size_t i, Thickness& out) const {
    const Mesh& mesh = scene_.mesh();
    const Vector3d normal = normals_[i].cast<double>();
    const Vector3d vertex = mesh.vertices_mm[i].cast<double>();
    const Vector3d inward = -normal;
    const auto hit = normal.squaredNorm() > 0.5
                         ? scene_.first_hit(vertex + start_mm_ * inward, inward)
                         : std::optional<RayHit>{};
    if (!hit) {
      out.status[i] = ThicknessStatus::NoWall;
      return;
    }
    const double cosine = hit->normal.dot(inward);
    if (!(cosine >= std::cos(kWallLimits.max_tilt_rad))) {
      out.status[i] = ThicknessStatus::Oblique;
      return;
    }
    if (mark_of(mesh, hit->triangle) == Mark::Synthesized) {
      out.status[i] = ThicknessStatus::Synthesized;
      return;
    }
    out.thickness_mm[i] = static_cast<float>(start_mm_ + hit->distance);
    if (out.u_mm.empty()) return;
    out.u_mm[i] = static_cast<float>(uncertainty(i, *hit, cosine));
  }

  /// Leaves out the vertices whose triangles face too differently.
  void find_sharp_edges(std::vector<ThicknessStatus>& status) const {
    const auto sharp = sharp_edge_flags(scene_.mesh(), normals_, kWallLimits.max_edge_rad);
    for (std::size_t i = 0; i < status.size(); ++i) {
      if (status[i] == ThicknessStatus::Measured && sharp[i] != 0)
        status[i] = ThicknessStatus::SharpEdge;
    }
  }

 private:
  /// Of a vertex and of the wall that the ray meets at an angle of this cosine.
  [[nodiscard]] double uncertainty(std::size_t i, const RayHit& hit, double cosine) const {
    const Mesh& mesh = scene_.mesh();
    const std::vector<float>& noise = noise_mm_of(mesh);
    const double independent =
        std::hypot(static_cast<double>(noise[i]), value_at(mesh, noise, hit) / cosine);
    const std::vector<float>& shared = mesh.sigma_systematic_mm;
    if (shared.empty()) return independent;
    return std::hypot(independent,
                      static_cast<double>(shared[i]) + value_at(mesh, shared, hit) / cosine);
  }

  const RayScene& scene_;
  std::vector<Eigen::Vector3f> normals_;
  double start_mm_ = 0.0;
};

/// The value below which a share of the weight lies. `values` are sorted.
double weighted_quantile(const std::vector<std::pair<float, double>>& values,
                         double all,
                         double share) {
  double sum = 0.0;
  for (const auto& [value, weight] : values) {
    sum += weight;
    if (sum >= share * all) return static_cast<double>(value);
  }
  return static_cast<double>(values.back().first);
}

}  // namespace

Thickness thickness_of(const RayScene& scene, const Run& run) {
  const Mesh& mesh = scene.mesh();
  if (mesh.triangles.empty())
    throw Error(ErrorKind::Input, "the mesh has no triangles: it has no walls");
  const std::size_t count = mesh.vertices_mm.size();
  Thickness out;
  out.thickness_mm.assign(count, kMissing);
  if (!mesh.sigma_mm.empty()) out.u_mm.assign(count, kMissing);
  for (const VertexUse use : vertex_uses(mesh))
    out.status.push_back(thickness_status_of(use));
  const WallFinder finder(scene);
  finder.find_sharp_edges(out.status);
  constexpr std::size_t kChunk = 4096;
  interruptible_chunks(count, kChunk, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      if (out.status[i] == ThicknessStatus::Measured) finder.measure(i, out);
  });
  return out;
}

ThicknessSummary summarize(const Mesh& mesh, const Thickness& thickness) {
  ThicknessSummary summary;
  const std::vector<double> areas = vertex_areas(mesh);
  std::vector<std::pair<float, double>> values;
  std::vector<float> u_mm;
  double sum = 0.0;
  std::size_t thinnest = 0;
  for (std::size_t i = 0; i < thickness.status.size(); ++i) {
    ++summary.count.at(static_cast<std::size_t>(thickness.status[i]));
    if (thickness.status[i] != ThicknessStatus::Measured) continue;
    const float value = thickness.thickness_mm[i];
    if (values.empty() || value < thickness.thickness_mm[thinnest]) thinnest = i;
    values.emplace_back(value, areas[i]);
    summary.area_mm2 += areas[i];
    sum += areas[i] * static_cast<double>(value);
    if (!thickness.u_mm.empty() && std::isfinite(thickness.u_mm[i]))
      u_mm.push_back(thickness.u_mm[i]);
  }
  if (values.empty()) return summary;
  std::sort(values.begin(), values.end());
  summary.min_mm = static_cast<double>(values.front().first);
  summary.max_mm = static_cast<double>(values.back().first);
  summary.min_at_mm = mesh.vertices_mm[thinnest].cast<double>();
  if (summary.area_mm2 > 0.0) summary.mean_mm = sum / summary.area_mm2;
  summary.p5_mm = weighted_quantile(values, summary.area_mm2, 0.05);
  summary.median_mm = weighted_quantile(values, summary.area_mm2, 0.5);
  summary.p95_mm = weighted_quantile(values, summary.area_mm2, 0.95);
  if (!thickness.u_mm.empty()) {
    summary.min_u_mm = static_cast<double>(thickness.u_mm[thinnest]);
    if (!u_mm.empty()) summary.median_u_mm = static_cast<double>(median(std::move(u_mm)));
  }
  return summary;
}

}  // namespace frangia
