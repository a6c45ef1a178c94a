#include "frangia/indirect_light/lit_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "frangia/core/missing.h"
#include "frangia/geometry/cosine_cells.h"
#include "frangia/range/triangulate.h"

namespace frangia {
namespace {

using Eigen::Vector3d;

constexpr int kRings = 12;
constexpr int kSectors = 16;
static_assert(kRings * kSectors == LitSurface::kCells);

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

/// Whether a corner with this normal belongs to another face than its triangle: the normal of a
/// vertex on a crease belongs to neither side, and would tilt the whole triangle.
bool is_tilted(const Vector3d& corner, const Vector3d& triangle) {
  constexpr double kMostTilt = 0.95;  // cosine of 18 degrees
  return corner.dot(triangle) < kMostTilt;
}

/// Two tangents and the normal.
Eigen::Matrix3d frame_about(const Vector3d& normal) {
  Eigen::Matrix3d out;
  out.col(0) = normal.unitOrthogonal();
  out.col(1) = normal.cross(out.col(0));
  out.col(2) = normal;
  return out;
}

/// Turns directions about the z axis to directions about a normal.
Eigen::Matrix3d turn_to(const Vector3d& normal) {
  return frame_about(normal) * frame_about(Vector3d::UnitZ()).transpose();
}

/// The cells about the z axis.
const std::vector<CosineCell>& cells() {
  static const std::vector<CosineCell> all = cosine_cells(Vector3d::UnitZ(), kRings, kSectors, 0.5);
  return all;
}

/// Cells are traced in parts that are spread over the hemisphere: the gaps between the 48
/// directions of the first fill a fiftieth of it.
constexpr std::size_t kParts = 4;

std::size_t part_of(std::size_t cell) {
  return (cell + cell / kSectors) % kParts;
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
  for (const Pattern& pattern : patterns_)
    ratios_.push_back(pattern.fringes_per_unit() / patterns_.back().fringes_per_unit());
}

Vector3d LitSurface::normal_at(const RayHit& hit) const {
  const auto& corners = scene_.mesh().triangles[hit.triangle];
  Vector3d normal = Vector3d::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d corner = scene_.mesh().normals[corners[k]].cast<double>();
    normal += hit.barycentric[static_cast<Eigen::Index>(k)] *
              (is_tilted(corner, hit.normal) ? hit.normal : corner);
  }
  return normal.normalized();
}

bool LitSurface::is_on_crease(std::size_t triangle, std::size_t corner) const {
  const Mesh& mesh = scene_.mesh();
  const auto& corners = mesh.triangles[triangle];
  const Vector3d a = mesh.vertices_mm[corners[0]].cast<double>();
  const Vector3d b = mesh.vertices_mm[corners[1]].cast<double>();
  const Vector3d c = mesh.vertices_mm[corners[2]].cast<double>();
  return is_tilted(mesh.normals[corners[corner]].cast<double>(), (b - a).cross(c - a).normalized());
}

double LitSurface::direct_light(const Eigen::Isometry3d& rig_from_object,
                                const Vector3d& lamp_mm,
                                const ShadedPoint& on) const {
  const Vector3d to_light = lamp_mm - on.point_mm;
  const double cosine = on.normal.dot(to_light.normalized());
  if (cosine <= 0.0) return 0.0;
  if (!is_in_field(rig_from_object * on.point_mm, projector_)) return 0.0;
  if (scene_.occluded(on.point_mm + step_off_mm_ * on.normal, lamp_mm)) return 0.0;
  return cosine / to_light.squaredNorm();
}

std::optional<SeenPatch> LitSurface::look(const ShadedPoint& from,
                                          const Eigen::Matrix3d& turned,
                                          std::size_t cell) const {
  const Vector3d origin = from.point_mm + step_off_mm_ * from.normal;
  const Vector3d direction = turned * cells()[cell].center;
  const auto hit = scene_.first_hit(origin, direction);
  if (!hit) return std::nullopt;
  const Vector3d nowhere = Vector3d::Constant(kMissing);
  SeenPatch patch{.hit = *hit,
                  .at = {origin + hit->distance * direction, hit->normal},
                  .is_inside = hit->normal.dot(direction) >= 0.0,
                  .sides_mm = {{{nowhere, nowhere}, {nowhere, nowhere}}}};
  if (patch.is_inside) {
    constexpr double kThickness = 8.0;  // steps off the surface: less is the surface itself
    if (hit->distance > kThickness * step_off_mm_) return patch;
    return std::nullopt;
  }
  patch.at.normal = normal_at(*hit);
  for (std::size_t k = 0; k < 2; ++k) {
    for (std::size_t end = 0; end < 2; ++end) {
      const Vector3d side = turned * cells()[cell].sides.at(k).at(end);
      const double slope = hit->normal.dot(side);
      if (slope < -1e-6)
        patch.sides_mm.at(k).at(end) =
            origin + hit->normal.dot(patch.at.point_mm - origin) / slope * side;
    }
  }
  return patch;
}

std::vector<SeenPatch> LitSurface::look_around(const ShadedPoint& from) const {
  const Eigen::Matrix3d turned = turn_to(from.normal);
  std::vector<SeenPatch> out;
  for (std::size_t part = 0; part < kParts; ++part) {
    if (part == 1 && out.empty()) return out;
    for (std::size_t i = 0; i < cells().size(); ++i) {
      if (part_of(i) != part) continue;
      if (const auto patch = look(from, turned, i)) out.push_back(*patch);
    }
  }
  return out;
}

bool LitSurface::sees_something(const ShadedPoint& from) const {
  const Eigen::Matrix3d turned = turn_to(from.normal);
  for (std::size_t i = 0; i < cells().size(); ++i)
    if (part_of(i) == 0 && look(from, turned, i)) return true;
  return false;
}

void LitSurface::add(double light,
                     double phase_rad,
                     const std::array<double, 2>& extents_rad,
                     PointLight& to) const {
  to.indirect += light / kCells;
  // The patterns share their direction: phases differ by the ratio of their frequencies.
  for (std::size_t m = 0; m < patterns_.size(); ++m) {
    to.fringes[m] += mean_over(ratios_[m] * extents_rad[0]) *
                     mean_over(ratios_[m] * extents_rad[1]) *
                     std::polar(light / kCells, ratios_[m] * phase_rad);
  }
}

double LitSurface::unknown_light(const Vector3d& lamp_mm, const Vector3d& point_mm) {
  constexpr double kUsualCosine = 0.5;
  return kUsualCosine / kCells / (lamp_mm - point_mm).squaredNorm();
}

PointLight LitSurface::light_along(const Eigen::Isometry3d& rig_from_object,
                                   const Vector3d& origin_mm,
                                   const Vector3d& direction,
                                   double& distance) const {
  PointLight out;
  out.fringes.assign(patterns_.size(), 0.0);
  const auto seen = scene_.first_hit(origin_mm, direction);
  distance = seen ? seen->distance : 0.0;
  if (!seen || seen->normal.dot(direction) >= 0.0) return out;
  const ShadedPoint to{origin_mm + seen->distance * direction, normal_at(*seen)};
  const Vector3d lamp_mm = rig_from_object.inverse() * projector_.position_mm;
  out.direct = direct_light(rig_from_object, lamp_mm, to);
  if (!(out.direct > 0.0)) return out;
  const auto phase_of = [&](const Vector3d& point) {
    return phase_at(rig_from_object * point, patterns_.back(), projector_);
  };
  for (const SeenPatch& patch : look_around(to)) {
    if (patch.is_inside) {  // what was not measured there may be lit
      out.unknown += unknown_light(lamp_mm, to.point_mm);
      continue;
    }
    const double light = direct_light(rig_from_object, lamp_mm, patch.at);
    if (light <= 0.0) continue;
    std::array<double, 2> extents_rad{};
    for (std::size_t k = 0; k < 2; ++k) {
      extents_rad.at(k) = phase_of(patch.sides_mm.at(k)[1]) - phase_of(patch.sides_mm.at(k)[0]);
    }
    add(light, phase_of(patch.at.point_mm), extents_rad, out);
  }
  return out;
}

}  // namespace frangia
