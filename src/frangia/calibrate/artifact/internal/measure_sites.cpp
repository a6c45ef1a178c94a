#include "frangia/calibrate/artifact/internal/measure_sites.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "frangia/calibrate/internal/artifact_sites.h"
#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/dataset/read_frames.h"
#include "frangia/range/fringe_ray.h"

namespace frangia {
namespace {

/// The pattern of which `LightSite::light` counts the units.
Pattern unit_pattern(const Rig& rig) {
  Pattern pattern;
  if (rig.projector.is_angular()) {
    pattern.fringes_per_degree = 1.0;
  } else {
    pattern.period_px = 1.0;
  }
  return pattern;
}

}  // namespace

void fail_artifact(const Scan& scan, const std::string& sentence) {
  throw Error(ErrorKind::Input,
              fmt::format("{}: {}", (scan.folder / "scan.toml").string(), sentence));
}

int site_step(const CameraModel& model, int sites) {
  return std::max(1, std::max(model.width_px, model.height_px) / sites);
}

MeasureLightOptions site_options(int step_px) {
  constexpr double kQuadratic = 1.87;  // root of the variance factor of its value, 3.5
  constexpr int kLargest_px = 12;      // beyond it the time grows, and a surface is not quadratic
  MeasureLightOptions options;
  options.step_px = step_px;
  options.fit.radius_px =
      std::clamp(static_cast<int>(std::lround(0.5 * (kQuadratic * step_px - 1.0))), 2, kLargest_px);
  const int side = 2 * options.fit.radius_px + 1;
  options.fit.min_pixels = side * side / 2;
  return options;
}

std::vector<std::vector<LightSite>> measure_sites(const Scan& scan,
                                                  const Rig& rig,
                                                  const MeasureLightOptions& options,
                                                  const Run& run) {
  std::vector<std::vector<LightSite>> views;
  for (std::size_t i = 0; i < scan.views.size(); ++i) {
    run.report(static_cast<double>(i) / static_cast<double>(scan.views.size()));
    run.check();
    views.push_back(measure_light(read_frames(scan, i, run), rig, options, run));
  }
  return views;
}

std::vector<Eigen::Vector3d> site_points(const std::vector<LightSite>& sites, const Rig& rig) {
  const Pattern pattern = unit_pattern(rig);
  const double phase_per_light = rig.projector.is_angular() ? kTwoPi * deg_from_rad(1.0) : kTwoPi;
  std::vector<Eigen::Vector3d> points;
  for (const LightSite& site : sites) {
    const Eigen::Vector2d ray = rig.reference().model.ray(site.camera_px);
    const double phase = phase_per_light * site.light.x();
    points.emplace_back(intersect_fringe(ray, phase, pattern, rig.projector).depth_mm *
                        ray.homogeneous());
  }
  return points;
}

Eigen::Isometry3d table_turn(const Rig& rig, double angle_rad) {
  return rig.rig_from_object(angle_rad) * rig.rig_from_object(0.0).inverse();
}

}  // namespace frangia
