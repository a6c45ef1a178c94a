#include "frangia/indirect_light/surface_light.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/range/triangulate.h"

namespace frangia {
namespace {

using Eigen::Vector3d;

double longest_edge_mm(const Mesh& mesh, std::size_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  return static_cast<double>(std::max({(mesh.vertices_mm[a] - mesh.vertices_mm[b]).norm(),
                                       (mesh.vertices_mm[b] - mesh.vertices_mm[c]).norm(),
                                       (mesh.vertices_mm[c] - mesh.vertices_mm[a]).norm()}));
}

/// Four times the median of the longest edges of the triangles.
double long_edge_mm(const Mesh& mesh) {
  constexpr double kLong = 4.0;
  std::vector<double> edges;
  const std::size_t stride = mesh.triangles.size() / 1000 + 1;
  for (std::size_t i = 0; i < mesh.triangles.size(); i += stride)
    edges.push_back(longest_edge_mm(mesh, i));
  if (edges.empty()) return 0.0;
  const auto middle = edges.begin() + std::ssize(edges) / 2;
  std::nth_element(edges.begin(), middle, edges.end());
  return kLong * *middle;
}

/// The change of a value that is linear in a triangle, along a vector of its plane.
struct TriangleStep {
  double along_first = 0.0;   ///< of the edge from the first corner to the second
  double along_second = 0.0;  ///< of the edge from the first corner to the third
};

TriangleStep step_in(const std::array<Vector3d, 2>& edges, const Vector3d& step) {
  const double aa = edges[0].squaredNorm();
  const double ab = edges[0].dot(edges[1]);
  const double bb = edges[1].squaredNorm();
  const double a = edges[0].dot(step);
  const double b = edges[1].dot(step);
  const double determinant = aa * bb - ab * ab;
  return {(a * bb - b * ab) / determinant, (b * aa - a * ab) / determinant};
}

/// A patch with what each pose needs of it.
struct Emitter {
  const SeenPatch* patch = nullptr;
  std::array<std::uint32_t, 3> vertices{};
  std::array<TriangleStep, 2> extents{};
};

}  // namespace

bool is_same_pose(const Eigen::Isometry3d& one, const Eigen::Isometry3d& other) {
  constexpr double kRounding = 1e-9;  // of the length of a pose
  return one.isApprox(other, kRounding);
}

SurfaceLight::SurfaceLight(std::shared_ptr<const LitSurface> surface,
                           std::span<const Eigen::Isometry3d> poses)
    : surface_(std::move(surface)) {
  for (const Eigen::Isometry3d& pose : poses) {
    poses_.push_back({pose, pose.inverse() * surface_->projector().position_mm, {}, {}, {}});
    light_vertices(poses_.back());
  }
  collect(place_points());
}

/// Places the points at which light is collected.
std::vector<ShadedPoint> SurfaceLight::place_points() {
  constexpr double kInset = 0.15;  // of a point on a crease, from its corner to the middle
  const Mesh& mesh = surface_->scene().mesh();
  const double longest_mm = long_edge_mm(mesh);
  std::vector<ShadedPoint> points;
  std::vector<std::uint32_t> of_vertex(mesh.vertices_mm.size(), kNothing);
  corners_.assign(mesh.triangles.size(), {kNothing, kNothing, kNothing});
  is_long_.assign(mesh.triangles.size(), 0);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    is_long_[i] = longest_edge_mm(mesh, i) > longest_mm ? 1 : 0;
    if (is_long_[i] != 0) continue;
    const auto& corners = mesh.triangles[i];
    const Vector3d a = mesh.vertices_mm[corners[0]].cast<double>();
    const Vector3d b = mesh.vertices_mm[corners[1]].cast<double>();
    const Vector3d c = mesh.vertices_mm[corners[2]].cast<double>();
    const Vector3d normal = (b - a).cross(c - a).normalized();
    if (!normal.allFinite()) continue;
    const Vector3d middle = (a + b + c) / 3.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3d at = mesh.vertices_mm[corners[k]].cast<double>();
      const auto next = static_cast<std::uint32_t>(points.size());
      if (surface_->is_on_crease(i, k)) {
        corners_[i][k] = next;
        points.push_back({at + kInset * (middle - at), normal});
        continue;
      }
      std::uint32_t& known = of_vertex[corners[k]];
      if (known == kNothing) {
        known = next;
        points.push_back({at, mesh.normals[corners[k]].cast<double>()});
      }
      corners_[i][k] = known;
    }
  }
  return points;
}

void SurfaceLight::light_vertices(Pose& pose) const {
  const Mesh& mesh = surface_->scene().mesh();
  pose.lit.assign(mesh.vertices_mm.size(), 0.0F);
  pose.phase_rad.assign(mesh.vertices_mm.size(), kMissing);
  parallel_chunks(mesh.vertices_mm.size(), 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const ShadedPoint at{mesh.vertices_mm[v].cast<double>(), mesh.normals[v].cast<double>()};
      pose.lit[v] =
          surface_->direct_light(pose.rig_from_object, pose.lamp_mm, at) > 0.0 ? 1.0F : 0.0F;
      pose.phase_rad[v] = phase_at(
          pose.rig_from_object * at.point_mm, surface_->patterns().back(), surface_->projector());
    }
  });
}

/// Finds what the points see; those that see something become receivers, and collect its light.
void SurfaceLight::collect(const std::vector<ShadedPoint>& points) {
  constexpr std::size_t kChunk = 64;
  std::vector<std::vector<SeenPatch>> seen(std::min<std::size_t>(points.size(), 64 * kChunk));
  std::vector<std::uint32_t> receivers(points.size(), kNothing);
  // Batch by batch, so that memory holds the patches of some points only.
  for (std::size_t first = 0; first < points.size(); first += seen.size()) {
    const std::size_t count = std::min(seen.size(), points.size() - first);
    parallel_chunks(count, kChunk, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        seen[i] = surface_->look_around(points[first + i]);
    });
    for (std::size_t i = 0; i < count; ++i) {
      if (!seen[i].empty()) receivers[first + i] = static_cast<std::uint32_t>(receivers_++);
    }
    for (Pose& pose : poses_)
      pose.collected.resize(receivers_ * values(), kMissing);
    parallel_chunks(count, kChunk, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        if (!seen[i].empty()) collect_at(receivers[first + i], points[first + i], seen[i]);
      }
    });
  }
  for (auto& corners : corners_) {
    for (std::uint32_t& corner : corners)
      if (corner != kNothing) corner = receivers[corner];
  }
}

void SurfaceLight::collect_at(std::size_t receiver,
                              const ShadedPoint& point,
                              const std::vector<SeenPatch>& patches) {
  const Mesh& mesh = surface_->scene().mesh();
  std::vector<Emitter> emitters;
  std::size_t inside = 0;
  for (const SeenPatch& patch : patches) {
    if (patch.is_inside) {
      ++inside;
      continue;
    }
    Emitter one{&patch, mesh.triangles[patch.hit.triangle], {}};
    const Vector3d a = mesh.vertices_mm[one.vertices[0]].cast<double>();
    const std::array<Vector3d, 2> edges{mesh.vertices_mm[one.vertices[1]].cast<double>() - a,
                                        mesh.vertices_mm[one.vertices[2]].cast<double>() - a};
    for (std::size_t k = 0; k < 2; ++k)
      one.extents.at(k) = step_in(edges, patch.sides_mm.at(k)[1] - patch.sides_mm.at(k)[0]);
    emitters.push_back(one);
  }
  PointLight light;
  for (Pose& pose : poses_) {
    if (point.normal.dot(pose.lamp_mm - point.point_mm) <= 0.0) continue;
    light = {};
    light.fringes.assign(surface_->patterns().size(), 0.0);
    for (const Emitter& one : emitters) {
      double lit = 0.0;
      double phase_rad = 0.0;
      for (std::size_t k = 0; k < 3; ++k) {
        const double weight = one.patch->hit.barycentric[static_cast<Eigen::Index>(k)];
        lit += weight * static_cast<double>(pose.lit[one.vertices.at(k)]);
        phase_rad += weight * pose.phase_rad[one.vertices.at(k)];
      }
      if (!(lit > 0.0) || std::isnan(phase_rad)) continue;
      const Vector3d to_lamp = pose.lamp_mm - one.patch->at.point_mm;
      const double square = to_lamp.squaredNorm();
      const double cosine = one.patch->at.normal.dot(to_lamp) / std::sqrt(square);
      if (cosine <= 0.0) continue;
      std::array<double, 2> extents_rad{};
      const double first = pose.phase_rad[one.vertices[0]];
      for (std::size_t k = 0; k < 2; ++k) {
        extents_rad.at(k) =
            one.extents.at(k).along_first * (pose.phase_rad[one.vertices[1]] - first) +
            one.extents.at(k).along_second * (pose.phase_rad[one.vertices[2]] - first);
      }
      surface_->add(lit * cosine / square, phase_rad, extents_rad, light);
    }
    light.unknown =
        static_cast<double>(inside) * LitSurface::unknown_light(pose.lamp_mm, point.point_mm);
    float* out = &pose.collected[receiver * values()];
    *out++ = static_cast<float>(light.indirect);
    *out++ = static_cast<float>(light.unknown);
    for (const std::complex<double>& fringes : light.fringes) {
      *out++ = static_cast<float>(fringes.real());
      *out++ = static_cast<float>(fringes.imag());
    }
  }
}

std::optional<std::size_t> SurfaceLight::pose_of(const Eigen::Isometry3d& rig_from_object) const {
  for (std::size_t i = 0; i < poses_.size(); ++i)
    if (is_same_pose(poses_[i].rig_from_object, rig_from_object)) return i;
  return std::nullopt;
}

PointLight SurfaceLight::light_along(std::size_t pose_index,
                                     const Vector3d& origin_mm,
                                     const Vector3d& direction,
                                     double& distance) const {
  const Pose& pose = poses_[pose_index];
  const auto seen = surface_->scene().first_hit(origin_mm, direction);
  if (seen && is_long_[seen->triangle] != 0)
    return surface_->light_along(pose.rig_from_object, origin_mm, direction, distance);
  PointLight out;
  out.fringes.assign(surface_->patterns().size(), 0.0);
  distance = seen ? seen->distance : 0.0;
  if (!seen || seen->normal.dot(direction) >= 0.0) return out;
  const ShadedPoint to{origin_mm + seen->distance * direction, surface_->normal_at(*seen)};
  out.direct = surface_->direct_light(pose.rig_from_object, pose.lamp_mm, to);
  if (!(out.direct > 0.0)) return out;
  double weights = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double weight = seen->barycentric[static_cast<Eigen::Index>(k)];
    const std::uint32_t receiver = corners_[seen->triangle][k];
    if (receiver == kNothing) {  // it sees nothing
      weights += weight;
      continue;
    }
    const float* found = &pose.collected[receiver * values()];
    if (std::isnan(*found)) continue;  // it faces away from the projector
    weights += weight;
    out.indirect += weight * static_cast<double>(*found++);
    out.unknown += weight * static_cast<double>(*found++);
    for (std::complex<double>& fringes : out.fringes) {
      const auto real = static_cast<double>(*found++);
      fringes += weight * std::complex<double>(real, static_cast<double>(*found++));
    }
  }
  if (!(weights > 0.0)) return out;
  out.indirect /= weights;
  out.unknown /= weights;
  for (std::complex<double>& fringes : out.fringes)
    fringes /= weights;
  return out;
}

}  // namespace frangia
