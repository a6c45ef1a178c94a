#include "frangia/pipeline/merge_scans.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/geometry/ray_scene.h"
#include "frangia/local_fit/make_surfel_maps.h"
#include "frangia/views/view_store.h"

namespace frangia {
namespace {

/// The virtual camera of one scan.
struct VirtualCamera {
  Eigen::Isometry3d rig_from_scan = Eigen::Isometry3d::Identity();
  double radius_mm = 0.0;
  double spacing_mm = 0.0;
};

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

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
    return median(lengths);
  }
  const std::size_t every = points.size() / kSamples + 1;
  for (std::size_t i = 0; i < points.size(); i += every) {
    float least = std::numeric_limits<float>::infinity();
    for (std::size_t j = 0; j < points.size(); ++j) {
      if (j != i) least = std::min(least, (points[j] - points[i]).squaredNorm());
    }
    lengths.push_back(std::sqrt(static_cast<double>(least)));
  }
  return median(lengths);
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
  const Eigen::Vector3d towards = mean_normal(scan.mesh);
  const Eigen::Vector3d right = towards.unitOrthogonal();
  camera.rig_from_scan.linear() << right.transpose(), -towards.cross(right).transpose(),
      -towards.transpose();
  camera.rig_from_scan.translation() =
      -(camera.rig_from_scan.linear() * box.center().cast<double>());
  return camera;
}

/// One camera model for all scans: its field holds the largest scan, and its pixel pitch is the
/// spacing of the densest.
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

/// Fills depths with the first hits of the camera's rays on the triangles.
void cast_rays(const RayScene& scene,
               const VirtualCamera& camera,
               const Image<Eigen::Vector2f>& rays,
               Image<float>& depth) {
  const Eigen::Isometry3d scan_from_rig = camera.rig_from_scan.inverse();
  parallel_rows(depth.height(), [&](int y) {
    for (int x = 0; x < depth.width(); ++x) {
      const Eigen::Vector3d ray = rays(x, y).homogeneous().cast<double>();
      const auto hit = scene.first_hit(scan_from_rig.translation(), scan_from_rig.linear() * ray);
      if (hit && hit->normal.dot(scan_from_rig.linear() * ray) < 0.0)
        depth(x, y) = static_cast<float>(hit->distance);
    }
  });
}

/// Fills depths with the nearest of the unorganized points in each pixel.
void splat(const Mesh& mesh,
           const VirtualCamera& camera,
           const CameraModel& model,
           Image<float>& depth) {
  for (const auto& point : mesh.vertices_mm) {
    const Eigen::Vector3d seen = camera.rig_from_scan * point.cast<double>();
    const Eigen::Vector2d pixel = model.project(seen);
    const bool inside = pixel.x() > -0.5 && pixel.y() > -0.5 && pixel.x() < depth.width() - 0.5 &&
                        pixel.y() < depth.height() - 0.5;
    if (!inside) continue;
    const auto x = static_cast<int>(std::lround(pixel.x()));
    const auto y = static_cast<int>(std::lround(pixel.y()));
    const auto z = static_cast<float>(seen.z());
    if (!(depth(x, y) <= z)) depth(x, y) = z;
  }
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
  return median(second_differences) / kSigmas;
}

View view_of(const RangeScan& scan,
             const VirtualCamera& camera,
             const CameraModel& model,
             std::size_t& points) {
  const auto rays = rays_of(model);
  View view;
  view.range.depth_mm = Image<float>(model.width_px, model.height_px, kMissing);
  if (scan.mesh.triangles.empty()) {
    splat(scan.mesh, camera, model, view.range.depth_mm);
  } else {
    cast_rays(RayScene(scan.mesh), camera, rays, view.range.depth_mm);
  }
  constexpr double kMinNoise = 0.01;  // of the spacing, for scans without noise
  const auto sigma =
      static_cast<float>(std::max(noise_of(view.range.depth_mm), kMinNoise * camera.spacing_mm));
  view.range.sigma_mm = Image<float>(model.width_px, model.height_px, kMissing);
  for (std::size_t i = 0; i < view.range.depth_mm.pixels().size(); ++i) {
    if (std::isnan(view.range.depth_mm.pixels()[i])) continue;
    view.range.sigma_mm.pixels()[i] = sigma;
    ++points;
  }
  view.rig_from_object = camera.rig_from_scan * scan.world_from_scan.inverse();
  return view;
}

/// The scans and their resampled views.
struct ScanViews {
  const std::vector<RangeScan>& scans;
  CameraModel model;
  ViewStore views;
};

/// Whether poses must be found by shape.
bool poses_unknown(const ScanViews& all,
                   const std::vector<SurfelMap>& maps,
                   const MergeScansOptions& options) {
  if (options.poses != ScanPoses::Auto) return options.poses == ScanPoses::Shape;
  const bool posed = std::any_of(
      all.scans.begin(), all.scans.end(), [](const RangeScan& scan) { return scan.posed; });
  const double reach_mm =
      options.registration.reach_mm > 0.0 ? options.registration.reach_mm : default_reach_mm(maps);
  return !posed && !are_poses_plausible(all.views, maps, all.model, reach_mm);
}

/// Finds and refines poses as the options ask.
void register_scans(MergedScans& out,
                    ScanViews& all,
                    const MergeScansOptions& options,
                    const Run& run) {
  if (all.scans.size() < 2) {
    run.note("a single scan is not registered");
    return;
  }
  if (!options.register_poses && options.poses != ScanPoses::Shape) return;
  auto maps = make_surfel_maps(all.views, all.model);
  RegisterPosesOptions registration = options.registration;
  if (poses_unknown(all, maps, options)) {
    std::vector<std::string> names;
    names.reserve(all.scans.size());
    for (const RangeScan& scan : all.scans)
      names.push_back(scan.path.string());
    out.found_poses = find_view_poses(all.views, maps, all.model, names, run);
    run.note(out.found_poses->text());
    registration.reach_mm = out.found_poses->accuracy_mm;
  }
  if (!options.register_poses) return;
  out.registration = register_poses(all.views, std::move(maps), all.model, registration, run);
  if (out.registration->iterations > 0) run.note(out.registration->text());
}

}  // namespace

MergedScans merge_scans(const std::vector<RangeScan>& scans,
                        const MergeScansOptions& options,
                        const Run& run) {
  require(!scans.empty(), "there is no scan to merge; name at least one");
  std::vector<VirtualCamera> cameras;
  bool points_only = false;
  for (const RangeScan& scan : scans) {
    cameras.push_back(virtual_camera_of(scan));
    points_only = points_only || scan.mesh.triangles.empty();
  }
  ScanViews all{scans, common_camera_model(cameras, points_only), {}};
  MergedScans out;
  run.stage("range");
  for (std::size_t i = 0; i < scans.size(); ++i) {
    run.report(static_cast<double>(i) / static_cast<double>(scans.size()));
    all.views.add(view_of(scans[i], cameras[i], all.model, out.points));
  }
  run.stage("views");
  register_scans(out, all, options, run);
  run.stage("surface");
  out.mesh =
      finish_mesh(fuse_views(all.views, all.model, options.fusion, run), options.finish, run);
  return out;
}

}  // namespace frangia
