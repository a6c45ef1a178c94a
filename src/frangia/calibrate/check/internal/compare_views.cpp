#include "frangia/calibrate/check/internal/compare_views.h"

#include <algorithm>
#include <cmath>

#include "frangia/calibrate/internal/artifact_model.h"
#include "frangia/dataset/read_frames.h"

namespace frangia {
namespace {

/// Normal of the surface at a site, towards the camera; NaN at a depth edge.
Eigen::Vector3d normal_at(const PartView& view, int column, int row) {
  const SiteGrid& grid = view.grid;
  const Eigen::Vector3d right =
      view.points[grid.at(column + 1, row)] - view.points[grid.at(column - 1, row)];
  const Eigen::Vector3d down =
      view.points[grid.at(column, row + 1)] - view.points[grid.at(column, row - 1)];
  const Eigen::Vector3d normal = right.cross(down).normalized();
  return normal.dot(view.points[grid.at(column, row)]) > 0.0 ? Eigen::Vector3d(-normal) : normal;
}

}  // namespace

PartView measure_part_view(const Scan& scan, std::size_t view, int part_sites, const Run& run) {
  const Rig& rig = scan.rig;
  PartView out;
  out.camera = rig.reference().model;
  SiteGrid& grid = out.grid;
  grid.step = std::max(1, std::max(out.camera.width_px, out.camera.height_px) / part_sites);
  grid.columns = (out.camera.width_px - grid.step / 2 + grid.step - 1) / grid.step;
  grid.rows = (out.camera.height_px - grid.step / 2 + grid.step - 1) / grid.step;
  MeasureLightOptions light;
  light.step_px = grid.step;
  light.use_laser_line = true;
  light.fit.radius_px = 2;
  light.fit.min_pixels = 15;
  out.points = site_points(measure_light(read_frames(scan, view, run), rig, light, run), rig);
  return out;
}

void compare_views(const PartView& from,
                   const PartView& to,
                   double match_share,
                   PatchDistances& out) {
  constexpr double kSameSide = 0.8;  // cosine of two normals
  constexpr double kFrontal = 0.35;  // cosine of a normal and the ray
  constexpr int kPatch = 8;
  constexpr double kFewest = 24.0;  // points in a patch
  constexpr double kOverlap = 9.0;  // sites that share pixels
  struct Patch {
    double count = 0.0;
    double sum = 0.0;
    double squares = 0.0;
  };
  const int across = from.grid.columns / kPatch + 1;
  std::vector<Patch> patches(static_cast<std::size_t>(across * (from.grid.rows / kPatch + 1)));
  const Eigen::Isometry3d move = to.camera_from_zero * from.camera_from_zero.inverse();
  const SiteGrid& grid = to.grid;
  for (int row = 1; row + 1 < from.grid.rows; ++row) {
    for (int column = 1; column + 1 < from.grid.columns; ++column) {
      const Eigen::Vector3d& point = from.points[from.grid.at(column, row)];
      if (!point.allFinite()) continue;
      const Eigen::Vector3d here = move * point;
      if (!(here.z() > 0.0)) continue;
      const Eigen::Vector2d pixel = to.camera.project(here);
      const int middle = grid.step / 2;
      const double u = (pixel.x() - middle) / grid.step;
      const double v = (pixel.y() - middle) / grid.step;
      if (!(u > 0.5 && v > 0.5 && u < grid.columns - 1.5 && v < grid.rows - 1.5)) continue;
      const int x = static_cast<int>(std::lround(u));
      const int y = static_cast<int>(std::lround(v));
      const Eigen::Vector3d& other = to.points[grid.at(x, y)];
      const Eigen::Vector3d normal = normal_at(to, x, y);
      const Eigen::Vector3d own = move.linear() * normal_at(from, column, row);
      const bool same = normal.dot(own) > kSameSide && -normal.dot(other.normalized()) > kFrontal &&
                        -own.dot(here.normalized()) > kFrontal;
      const double distance = normal.dot(here - other);
      if (!same || !(std::abs(distance) < match_share * other.norm())) continue;
      const int number = row / kPatch * across + column / kPatch;
      Patch& patch = patches[static_cast<std::size_t>(number)];
      patch.count += 1.0;
      patch.sum += distance;
      patch.squares += distance * distance;
    }
  }
  for (const Patch& patch : patches) {
    if (patch.count < kFewest) continue;
    const double mean = patch.sum / patch.count;
    const double variance = std::max(patch.squares / patch.count - mean * mean, 0.0);
    out.mean_mm.push_back(mean);
    out.sigma_mm.push_back(std::sqrt(variance * kOverlap / patch.count));
  }
}

}  // namespace frangia
