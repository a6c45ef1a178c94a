#include "frangia/reconstruct/internal/resample_scan.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/core/statistics.h"
#include "frangia/geometry/ray_scene.h"
#include "frangia/reconstruct/internal/splat_points.h"

namespace frangia {
namespace {

/// Median distance of neighbouring points: shortest edges of triangles, or nearest neighbours.
double spacing_of(const Mesh& mesh) {
  constexpr std::size_t kSamples = 400;
  std::vector<double> lengths;
  const auto& points = mesh.vertices_mm;
  if (!mesh.triangles.empty()) {
    const std::size_t every = mesh.triangles.size() / kSamples + 1;
    for (std::size_t i = 0; i < mesh.triangles.size(); i += every) {
      const auto& [a, b, c] = mesh.triangles[i];
      lengths.push_back(static_cast<double>(std::min({(points[a] - points[b]).norm(),
                                                      (points[b] - points[c]).norm(),
                                                      (points[c] - points[a]).norm()})));
    }
    return median(std::move(lengths));
  }
  const std::size_t every = points.size() / kSamples + 1;
  for (std::size_t i = 0; i < points.size(); i += every) {
    float least = std::numeric_limits<float>::infinity();
    for (std::size_t j = 0; j < points.size(); ++j) {
      if (j != i) least = std::min(least, (points[j] - points[i]).squaredNorm());
    }
    lengths.push_back(std::sqrt(static_cast<double>(least)));
  }
  return median(std::move(lengths));
}

/// Area-weighted mean normal of the triangles; +z for unorganized points, as range scanners use it.
Eigen::Vector3d mean_normal(const Mesh& mesh) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d origin = mesh.vertices_mm[a].cast<double>();
    sum += (mesh.vertices_mm[b].cast<double>() - origin)
               .cross(mesh.vertices_mm[c].cast<double>() - origin);
  }
  return sum.norm() > 0.0 ? sum.normalized() : Eigen::Vector3d::UnitZ();
}

/// The color of a point on a triangle, interpolated between its corners.
PixelColor color_at(const Mesh& mesh, const RayHit& hit) {
  const Mesh::Triangle& corners = mesh.triangles[hit.triangle];
  PixelColor color{};
  for (std::size_t i = 0; i < color.size(); ++i) {
    const Eigen::Vector3d values(mesh.colors[corners[0]].at(i),
                                 mesh.colors[corners[1]].at(i),
                                 mesh.colors[corners[2]].at(i));
    color.at(i) =
        static_cast<std::uint8_t>(std::lround(std::clamp(hit.barycentric.dot(values), 0.0, 255.0)));
  }
  return color;
}

/// How far a ray goes on from its hit on a triangle to the curved surface of which the corners are
/// points, in units of the ray: to where the mean of its distances to the triangle and to the
/// tangent planes of the corners is 0. A curved surface lies between both, equally far from each:
/// the triangle alone would lie inside of a round part, the more so the farther apart its points
/// are, as where a scanner looks at it at grazing incidence.
double beyond_chord(const Mesh& mesh,
                    const std::vector<Eigen::Vector3f>& normals,
                    const RayHit& hit,
                    const Eigen::Vector3d& ray) {
  constexpr double kFlattest = 0.955;  // cosine of 0.3 rad, as the creases of `LocalPlanesOptions`
  const Mesh::Triangle& corners = mesh.triangles[hit.triangle];
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  for (Eigen::Index i = 0; i < 3; ++i)
    point += hit.barycentric[i] *
             mesh.vertices_mm[corners.at(static_cast<std::size_t>(i))].cast<double>();
  double in_front_mm = 0.0;
  double towards = hit.normal.dot(ray);
  for (Eigen::Index i = 0; i < 3; ++i) {
    const std::uint32_t corner = corners.at(static_cast<std::size_t>(i));
    const Eigen::Vector3d normal = normals[corner].cast<double>();
    if (!(normal.dot(hit.normal) > kFlattest)) return 0.0;  // at an edge
    in_front_mm += hit.barycentric[i] * normal.dot(point - mesh.vertices_mm[corner].cast<double>());
    towards += hit.barycentric[i] * normal.dot(ray);
  }
  constexpr double kGrazing = 0.1;  // sum of two cosines of incidence
  return -towards > kGrazing * ray.norm() ? -in_front_mm / towards : 0.0;
}

/// Fills depths with the first hits of the camera's rays on the surface of the triangles.
void cast_rays(const RayScene& scene,
               const VirtualCamera& camera,
               const Image<Eigen::Vector2f>& rays,
               Image<float>& depth,
               Image<PixelColor>& color) {
  const Eigen::Isometry3d scan_from_rig = camera.rig_from_scan.inverse();
  const std::vector<Eigen::Vector3f> normals = vertex_normals(scene.mesh());
  parallel_rows(depth.height(), [&](int y) {
    for (int x = 0; x < depth.width(); ++x) {
      const Eigen::Vector3d ray = scan_from_rig.linear() * rays(x, y).homogeneous().cast<double>();
      const auto hit = scene.first_hit(scan_from_rig.translation(), ray);
      if (!hit || !(hit->normal.dot(ray) < 0.0)) continue;
      depth(x, y) =
          static_cast<float>(hit->distance + beyond_chord(scene.mesh(), normals, *hit, ray));
      if (!color.empty()) color(x, y) = color_at(scene.mesh(), *hit);
    }
  });
}

/// Standard deviation from the median absolute second difference, which is zero on a plane.
double noise_of(const Image<float>& depth) {
  std::vector<double> second_differences;
  for (int y = 0; y < depth.height(); ++y) {
    for (int x = 1; x + 1 < depth.width(); ++x) {
      const float second_difference = depth(x - 1, y) - 2.0F * depth(x, y) + depth(x + 1, y);
      if (!std::isnan(second_difference))
        second_differences.push_back(std::abs(static_cast<double>(second_difference)));
    }
  }
  constexpr double kSigmas = 0.6745 * 2.449;  // of the median; six variances in a second difference
  return median(std::move(second_differences)) / kSigmas;
}

/// Counts the points that no pixel stands for. A point behind the depth of its pixel by more than a
/// few pixels is hidden. Of the points in one pixel, whose mean it is, one counts as kept.
DroppedPoints count_dropped(const Mesh& mesh,
                            const VirtualCamera& camera,
                            const CameraModel& model,
                            const Image<float>& depth) {
  constexpr double kSameSurface = 6.0;  // spacings, as the longest edge of a range grid
  DroppedPoints dropped;
  std::vector<bool> connected(mesh.vertices_mm.size(), mesh.triangles.empty());
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle)
      connected[corner] = true;
  }
  Image<std::uint8_t> taken(depth.width(), depth.height());
  for (std::size_t i = 0; i < mesh.vertices_mm.size(); ++i) {
    if (!connected[i]) {
      ++dropped.unconnected;
      continue;
    }
    const Eigen::Vector3d seen = camera.rig_from_scan * mesh.vertices_mm[i].cast<double>();
    const Eigen::Vector2d pixel = model.project(seen);
    const auto x = static_cast<int>(std::lround(std::clamp(pixel.x(), 0.0, depth.width() - 1.0)));
    const auto y = static_cast<int>(std::lround(std::clamp(pixel.y(), 0.0, depth.height() - 1.0)));
    double nearest = std::numeric_limits<double>::infinity();  // of the surface at the point
    for (int row = std::max(y - 1, 0); row <= std::min(y + 1, depth.height() - 1); ++row) {
      for (int column = std::max(x - 1, 0); column <= std::min(x + 1, depth.width() - 1);
           ++column) {
        const double there = static_cast<double>(depth(column, row));
        if (!std::isnan(there)) nearest = std::min(nearest, std::abs(seen.z() - there));
      }
    }
    if (!(nearest <= kSameSurface * camera.spacing_mm)) {
      ++dropped.hidden;
    } else if (std::exchange(taken(x, y), std::uint8_t{1}) != 0) {
      ++dropped.too_dense;
    }
  }
  return dropped;
}

}  // namespace

VirtualCamera virtual_camera_of(const RangeScan& scan) {
  if (!(scan.mesh.vertices_mm.size() > 2)) {
    throw Error(
        ErrorKind::Input,
        fmt::format("{}: holds no surface: it has fewer than 3 points", scan.path.string()));
  }
  Eigen::AlignedBox3f box;
  for (const auto& point : scan.mesh.vertices_mm)
    box.extend(point);
  VirtualCamera camera;
  camera.radius_mm = 0.5 * static_cast<double>(box.diagonal().norm());
  camera.spacing_mm = spacing_of(scan.mesh);
  const bool measurable = camera.spacing_mm > 0.0 && camera.radius_mm > 0.0 &&
                          std::isfinite(camera.spacing_mm) && std::isfinite(camera.radius_mm);
  if (!measurable) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: holds no surface: its points coincide or lie out of all "
                            "proportion; remove the stray points",
                            scan.path.string()));
  }
  // Fused coordinates are single-precision numbers, with 2^23 steps up to their largest value.
  constexpr double kMostSpacings = 1 << 20;
  const double distance_mm = (scan.world_from_scan * box.center().cast<double>()).norm();
  if (!(distance_mm < kMostSpacings * camera.spacing_mm)) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: its pose places it {:.3g} mm from the origin, more than a million "
                            "times the spacing of its points; correct the pose or move all poses "
                            "towards the origin",
                            scan.path.string(),
                            distance_mm));
  }
  const Eigen::Vector3d towards = mean_normal(scan.mesh);
  const Eigen::Vector3d right = towards.unitOrthogonal();
  camera.rig_from_scan.linear() << right.transpose(), -towards.cross(right).transpose(),
      -towards.transpose();
  camera.rig_from_scan.translation() =
      -(camera.rig_from_scan.linear() * box.center().cast<double>());
  return camera;
}

CameraModel common_camera_model(std::vector<VirtualCamera>& cameras, bool points_only) {
  constexpr double kFar = 5.0;  // radii
  constexpr int kMax_px = 4000;
  double radius_mm = 0.0;
  double spacing_mm = std::numeric_limits<double>::infinity();
  for (const VirtualCamera& camera : cameras) {
    radius_mm = std::max(radius_mm, camera.radius_mm);
    spacing_mm = std::min(spacing_mm, camera.spacing_mm);
  }
  if (points_only) spacing_mm *= 1.5;  // so that few pixels stay empty
  const double distance_mm = kFar * radius_mm;
  const double across = 2.0 * distance_mm * radius_mm / (distance_mm - radius_mm) / spacing_mm;
  CameraModel model;
  model.width_px = model.height_px =
      static_cast<int>(std::min<double>(kMax_px, std::ceil(across) + 8.0));
  const double focal = std::min(1.0, kMax_px / across) * distance_mm / spacing_mm;
  model.focal_px = {focal, focal};
  model.principal_point_px = {0.5 * (model.width_px - 1), 0.5 * (model.height_px - 1)};
  model.distortion = {};
  for (VirtualCamera& camera : cameras)
    camera.rig_from_scan.translation().z() += distance_mm;
  return model;
}

ResampledScan resample_scan(const RangeScan& scan,
                            const VirtualCamera& camera,
                            const CameraModel& model) {
  const auto rays = rays_of(model);
  ResampledScan out;
  View& view = out.view;
  view.range.depth_mm = Image<float>(model.width_px, model.height_px, kMissing);
  if (!scan.mesh.colors.empty())
    view.color = Image<PixelColor>(model.width_px, model.height_px, kUnknownColor);
  if (scan.mesh.triangles.empty()) {
    splat_points(scan.mesh, camera, model, view.range.depth_mm, view.color);
  } else {
    cast_rays(RayScene(scan.mesh), camera, rays, view.range.depth_mm, view.color);
  }
  constexpr double kMinNoise = 0.01;  // of the spacing, for scans without noise
  out.noise_mm = std::max(noise_of(view.range.depth_mm), kMinNoise * camera.spacing_mm);
  view.range.sigma_mm = Image<float>(model.width_px, model.height_px, kMissing);
  for (std::size_t i = 0; i < view.range.depth_mm.pixels().size(); ++i) {
    if (std::isnan(view.range.depth_mm.pixels()[i])) continue;
    view.range.sigma_mm.pixels()[i] = static_cast<float>(out.noise_mm);
    ++out.points;
  }
  out.dropped = count_dropped(scan.mesh, camera, model, view.range.depth_mm);
  view.rig_from_object = camera.rig_from_scan * scan.world_from_scan.inverse();
  return out;
}

}  // namespace frangia
