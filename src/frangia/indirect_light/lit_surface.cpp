#include "frangia/indirect_light/lit_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "frangia/core/missing.h"
#include "frangia/geometry/cosine_cells.h"
#include "frangia/range/fringe_ray.h"

namespace frangia {
namespace {

using Eigen::Vector3d;

constexpr int kRings = 12;
constexpr int kSectors = 16;

/// Half of the median of the shortest edges of the triangles.
double half_edge(const Mesh& mesh) {
  std::vector<float> edges;
  const std::size_t stride = mesh.triangles.size() / 1000 + 1;
  for (std::size_t i = 0; i < mesh.triangles.size(); i += stride) {
    const auto& [a, b, c] = mesh.triangles[i];
    edges.push_back(std::min({(mesh.vertices_mm[a] - mesh.vertices_mm[b]).norm(),
                              (mesh.vertices_mm[b] - mesh.vertices_mm[c]).norm(),
                              (mesh.vertices_mm[c] - mesh.vertices_mm[a]).norm()}));
  }
  if (edges.empty()) return 0.0;
  std::nth_element(
      edges.begin(), edges.begin() + static_cast<std::ptrdiff_t>(edges.size() / 2), edges.end());
  return 0.5 * static_cast<double>(edges[edges.size() / 2]);
}

/// Whether the projector lights a point of the rig frame.
bool is_in_field(const Vector3d& in_rig, const Projector& projector) {
  const Vector3d p = projector.from_rig(in_rig);
  if (const auto* pinhole = std::get_if<PinholeModel>(&projector.model)) {
    if (!(p.z() > 0.0)) return false;
    const Eigen::Vector2d pixel = pinhole->project(p);
    return pixel.minCoeff() >= -0.5 && pixel.x() <= pinhole->width_px - 0.5 &&
           pixel.y() <= pinhole->height_px - 0.5;
  }
  const auto& field = std::get<AngularModel>(projector.model);
  const double psi = std::atan2(p.x(), p.z());
  return psi >= field.field_min_rad && psi <= field.field_max_rad;
}

/// Mean over an extent of a fringe, relative to its amplitude; 0 for an unknown extent.
double mean_over(double extent_rad) {
  if (std::isnan(extent_rad)) return 0.0;
  const double half = 0.5 * extent_rad;
  return std::abs(half) < 1e-4 ? 1.0 : std::sin(half) / half;
}

}  // namespace

LitSurface::LitSurface(Mesh mesh, Projector projector, std::vector<Pattern> patterns)
    : scene_([&mesh] {
        if (mesh.normals.empty()) mesh.normals = vertex_normals(mesh);
        return std::move(mesh);
      }()),
      projector_(std::move(projector)),
      patterns_(std::move(patterns)),
      step_off_mm_(half_edge(scene_.mesh())) {
  // Long edges of a mesh of few triangles must not lift rays off its corners.
  Eigen::AlignedBox3f box;
  for (const auto& vertex : scene_.mesh().vertices_mm)
    box.extend(vertex);
  const double size_mm = box.isEmpty() ? 0.0 : static_cast<double>(box.diagonal().norm());
  step_off_mm_ = std::min(0.5 * step_off_mm_, 1e-4 * size_mm);
}

/// The interpolated normal. A corner on a crease takes part with the triangle's normal: the normal
/// of its vertex belongs to neither side, and would tilt the whole triangle.
Vector3d LitSurface::normal_at(const RayHit& hit) const {
  constexpr double kMostTilt = 0.95;  // cosine of 18 degrees
  const auto& corners = scene_.mesh().triangles[hit.triangle];
  Vector3d normal = Vector3d::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d corner = scene_.mesh().normals[corners[k]].cast<double>();
    normal += hit.barycentric[static_cast<Eigen::Index>(k)] *
              (corner.dot(hit.normal) < kMostTilt ? hit.normal : corner);
  }
  return normal.normalized();
}

double LitSurface::direct_light(const Eigen::Isometry3d& rig_from_object, const Hit& on) const {
  const Vector3d light = rig_from_object.inverse() * projector_.position_mm;
  const Vector3d to_light = light - on.point_mm;
  const double cosine = on.normal.dot(to_light.normalized());
  if (cosine <= 0.0) return 0.0;
  const Vector3d in_rig = rig_from_object * on.point_mm;
  if (!is_in_field(in_rig, projector_)) return 0.0;
  if (scene_.occluded(on.point_mm + step_off_mm_ * on.normal, light)) return 0.0;
  return cosine / to_light.squaredNorm();
}

PointLight LitSurface::light_along(const Eigen::Isometry3d& rig_from_object,
                                   const Vector3d& origin_mm,
                                   const Vector3d& direction,
                                   double& distance,
                                   const SurfaceSight* sight) const {
  PointLight out;
  out.fringes.assign(patterns_.size(), 0.0);
  const auto seen = scene_.first_hit(origin_mm, direction);
  distance = seen ? seen->distance : 0.0;
  if (!seen || seen->normal.dot(direction) >= 0.0) return out;
  const Hit to{origin_mm + seen->distance * direction, normal_at(*seen)};
  out.direct = direct_light(rig_from_object, to);
  if (!(out.direct > 0.0)) return out;
  if (sight != nullptr && !sight->sees_surface(seen->triangle)) return out;
  const Vector3d origin = to.point_mm + step_off_mm_ * to.normal;
  const auto meets = [&](const Vector3d& other, const RayHit& hit, const Vector3d& at) -> Vector3d {
    const double slope = hit.normal.dot(other);
    if (slope >= -1e-6) return Vector3d::Constant(kMissing);
    return origin + hit.normal.dot(at - origin) / slope * other;
  };
  constexpr double kUsualCosine = 0.5;
  const double unknown =
      kUsualCosine / (kRings * kSectors) /
      (rig_from_object.inverse() * projector_.position_mm - to.point_mm).squaredNorm();
  for (const CosineCell& cell : cosine_cells(to.normal, kRings, kSectors, 0.5)) {
    const auto hit = scene_.first_hit(origin, cell.center);
    if (!hit) continue;
    if (hit->normal.dot(cell.center) >= 0.0) {
      // Through a hole of the surface: what was not measured there may be lit.
      if (hit->distance > 8.0 * step_off_mm_) out.unknown += unknown;
      continue;
    }
    const Hit from{origin + hit->distance * cell.center, normal_at(*hit)};
    const double light = direct_light(rig_from_object, from) / (kRings * kSectors);
    if (light <= 0.0) continue;
    out.indirect += light;
    // The patterns share their direction: phases differ by the ratio of their frequencies.
    const Pattern& finest = patterns_.back();
    const auto phase_of = [&](const Vector3d& point) {
      return phase_at(rig_from_object * point, finest, projector_);
    };
    const double phase = phase_of(from.point_mm);
    std::array<double, 2> extents{};
    for (std::size_t k = 0; k < 2; ++k) {
      extents.at(k) = phase_of(meets(cell.sides.at(k)[1], *hit, from.point_mm)) -
                      phase_of(meets(cell.sides.at(k)[0], *hit, from.point_mm));
    }
    for (std::size_t m = 0; m < patterns_.size(); ++m) {
      const double ratio = patterns_[m].fringes_per_unit() / finest.fringes_per_unit();
      out.fringes[m] += mean_over(ratio * extents[0]) * mean_over(ratio * extents[1]) *
                        std::polar(light, ratio * phase);
    }
  }
  return out;
}

}  // namespace frangia
