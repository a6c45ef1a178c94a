#include "frangia/scan/paste_scans.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/mesh/ray_scene.h"
#include "frangia/views/map_views.h"
#include "frangia/views/view_store.h"

namespace frangia {
namespace {

/// Where a scan's own camera stands.
struct Stand {
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

/// The distance of neighbouring points: of triangles their edges, of loose points the nearest one.
double spacing_of(const Mesh& mesh) {
  constexpr std::size_t kLooks = 400;
  std::vector<double> lengths;
  const auto& points = mesh.vertices_mm;
  if (!mesh.triangles.empty()) {
    const std::size_t every = mesh.triangles.size() / kLooks + 1;
    for (std::size_t i = 0; i < mesh.triangles.size(); i += every) {
      const auto& [a, b, c] = mesh.triangles[i];
      lengths.push_back(static_cast<double>(std::min({(points[a] - points[b]).norm(),
                                                      (points[b] - points[c]).norm(),
                                                      (points[c] - points[a]).norm()})));
    }
    return median(lengths);
  }
  const std::size_t every = points.size() / kLooks + 1;
  for (std::size_t i = 0; i < points.size(); i += every) {
    float least = std::numeric_limits<float>::infinity();
    for (std::size_t j = 0; j < points.size(); ++j) {
      if (j != i) least = std::min(least, (points[j] - points[i]).squaredNorm());
    }
    lengths.push_back(std::sqrt(static_cast<double>(least)));
  }
  return median(lengths);
}

/// Where the triangles face, weighted by area; of loose points +z, as range scanners have it.
Eigen::Vector3d facing(const Mesh& mesh) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d origin = mesh.vertices_mm[a].cast<double>();
    sum += (mesh.vertices_mm[b].cast<double>() - origin)
               .cross(mesh.vertices_mm[c].cast<double>() - origin);
  }
  return sum.norm() > 0.0 ? sum.normalized() : Eigen::Vector3d::UnitZ();
}

Stand stand_of(const RangeScan& scan) {
  if (!(scan.mesh.vertices_mm.size() > 2)) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: holds no surface: it has {} points",
                            scan.path.string(),
                            scan.mesh.vertices_mm.size()));
  }
  Eigen::AlignedBox3f box;
  for (const auto& point : scan.mesh.vertices_mm)
    box.extend(point);
  Stand stand;
  stand.radius_mm = 0.5 * static_cast<double>(box.diagonal().norm());
  stand.spacing_mm = spacing_of(scan.mesh);
  const Eigen::Vector3d towards = facing(scan.mesh);
  const Eigen::Vector3d right = towards.unitOrthogonal();
  stand.rig_from_scan.linear() << right.transpose(), -towards.cross(right).transpose(),
      -towards.transpose();
  stand.rig_from_scan.translation() = -(stand.rig_from_scan.linear() * box.center().cast<double>());
  return stand;
}

/// One lens for all scans: it sees the largest, with pixels as far apart as the densest's points.
Lens lens_for(std::vector<Stand>& stands, bool loose) {
  constexpr double kFar = 5.0;  // radii
  constexpr int kMost_px = 4000;
  double radius_mm = 0.0;
  double spacing_mm = std::numeric_limits<double>::infinity();
  for (const Stand& stand : stands) {
    radius_mm = std::max(radius_mm, stand.radius_mm);
    spacing_mm = std::min(spacing_mm, stand.spacing_mm);
  }
  if (loose) spacing_mm *= 1.5;  // so that few pixels stay empty
  const double distance_mm = kFar * radius_mm;
  const double across = 2.0 * distance_mm * radius_mm / (distance_mm - radius_mm) / spacing_mm;
  Lens lens;
  lens.width_px = lens.height_px = std::min(kMost_px, static_cast<int>(std::ceil(across)) + 8);
  const double focal = std::min(1.0, kMost_px / across) * distance_mm / spacing_mm;
  lens.focal_px = {focal, focal};
  lens.principal_point_px = {0.5 * (lens.width_px - 1), 0.5 * (lens.height_px - 1)};
  lens.distortion = {};
  for (Stand& stand : stands)
    stand.rig_from_scan.translation().z() += distance_mm;
  return lens;
}

/// Depths where rays meet the triangles.
void cast_rays(const RayScene& scene,
               const Stand& stand,
               const Image<Eigen::Vector2f>& rays,
               Image<float>& depth) {
  const Eigen::Isometry3d scan_from_rig = stand.rig_from_scan.inverse();
  parallel_rows(depth.height(), [&](int y) {
    for (int x = 0; x < depth.width(); ++x) {
      const Eigen::Vector3d ray = rays(x, y).homogeneous().cast<double>();
      const auto hit = scene.first_hit(scan_from_rig.translation(), scan_from_rig.linear() * ray);
      if (hit && hit->normal.dot(scan_from_rig.linear() * ray) < 0.0)
        depth(x, y) = static_cast<float>(hit->distance);
    }
  });
}

/// Depths of loose points, the nearest of each pixel.
void splat(const Mesh& mesh, const Stand& stand, const Lens& lens, Image<float>& depth) {
  for (const auto& point : mesh.vertices_mm) {
    const Eigen::Vector3d seen = stand.rig_from_scan * point.cast<double>();
    const Eigen::Vector2d pixel = lens.project(seen);
    const auto x = static_cast<int>(std::lround(pixel.x()));
    const auto y = static_cast<int>(std::lround(pixel.y()));
    if (x < 0 || y < 0 || x >= depth.width() || y >= depth.height()) continue;
    const auto z = static_cast<float>(seen.z());
    if (!(depth(x, y) <= z)) depth(x, y) = z;
  }
}

/// From second differences, which no plane has.
double noise_of(const Image<float>& depth) {
  std::vector<double> bends;
  for (int y = 0; y < depth.height(); ++y) {
    for (int x = 1; x + 1 < depth.width(); ++x) {
      const float bend = depth(x - 1, y) - 2.0F * depth(x, y) + depth(x + 1, y);
      if (!std::isnan(bend)) bends.push_back(std::abs(static_cast<double>(bend)));
    }
  }
  constexpr double kSigmas = 0.6745 * 2.449;  // of the median; six variances in a second difference
  return median(bends) / kSigmas;
}

View view_of(const RangeScan& scan, const Stand& stand, const Lens& lens, std::size_t& points) {
  const auto rays = rays_of(lens);
  View view;
  view.range.depth_mm = Image<float>(lens.width_px, lens.height_px, kMissing);
  if (scan.mesh.triangles.empty()) {
    splat(scan.mesh, stand, lens, view.range.depth_mm);
  } else {
    cast_rays(RayScene(scan.mesh), stand, rays, view.range.depth_mm);
  }
  constexpr double kLeast = 0.01;  // of the spacing: no scanner is better
  const auto sigma =
      static_cast<float>(std::max(noise_of(view.range.depth_mm), kLeast * stand.spacing_mm));
  view.range.sigma_mm = Image<float>(lens.width_px, lens.height_px, kMissing);
  for (std::size_t i = 0; i < view.range.depth_mm.pixels().size(); ++i) {
    if (std::isnan(view.range.depth_mm.pixels()[i])) continue;
    view.range.sigma_mm.pixels()[i] = sigma;
    ++points;
  }
  view.rig_from_object = stand.rig_from_scan * scan.world_from_scan.inverse();
  return view;
}

/// The scans, and what our own camera sees of each.
struct ScanViews {
  const std::vector<RangeScan>& scans;
  Lens lens;
  ViewStore views;
};

/// Whether the scans' own poses cannot be meant.
bool poses_unknown(const ScanViews& all,
                   const std::vector<PlaneMap>& maps,
                   const PasteScansOptions& options) {
  if (options.poses != ScanPoses::Auto) return options.poses == ScanPoses::Shape;
  const bool posed = std::any_of(
      all.scans.begin(), all.scans.end(), [](const RangeScan& scan) { return scan.posed; });
  return !posed && !poses_can_be(all.views, maps, all.lens, options.registration.reach_mm);
}

/// Poses found and refined, as the options say.
void bring_together(PastedScans& out,
                    ScanViews& all,
                    const PasteScansOptions& options,
                    const Run& run) {
  if (all.scans.size() < 2) {
    run.note("one scan alone has nothing to be registered with");
    return;
  }
  if (!options.register_poses && options.poses != ScanPoses::Shape) return;
  auto maps = map_views(all.views, all.lens);
  RegisterPosesOptions registration = options.registration;
  if (poses_unknown(all, maps, options)) {
    std::vector<std::string> names;
    names.reserve(all.scans.size());
    for (const RangeScan& scan : all.scans)
      names.push_back(scan.path.string());
    out.placed = place_views(all.views, maps, all.lens, names, run);
    run.note(out.placed->text());
    registration.reach_mm = out.placed->near_mm;
  }
  if (!options.register_poses) return;
  out.registration = register_poses(all.views, std::move(maps), all.lens, registration, run);
  if (out.registration->iterations > 0) run.note(out.registration->text());
}

}  // namespace

PastedScans paste_scans(const std::vector<RangeScan>& scans,
                        const PasteScansOptions& options,
                        const Run& run) {
  require(!scans.empty(), "paste_scans: there is no scan to paste");
  std::vector<Stand> stands;
  bool loose = false;
  for (const RangeScan& scan : scans) {
    stands.push_back(stand_of(scan));
    loose = loose || scan.mesh.triangles.empty();
  }
  ScanViews all{scans, lens_for(stands, loose), {}};
  PastedScans out;
  run.stage("range");
  for (std::size_t i = 0; i < scans.size(); ++i) {
    run.report(static_cast<double>(i) / static_cast<double>(scans.size()));
    all.views.add(view_of(scans[i], stands[i], all.lens, out.points));
  }
  run.stage("views");
  bring_together(out, all, options, run);
  run.stage("surface");
  out.mesh = finish_mesh(paste_views(all.views, all.lens, options.paste, run), options.finish, run);
  return out;
}

}  // namespace frangia
