#include "frangia/calibrate/check/check_kinds.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "frangia/calibrate/check/internal/check_limits.h"
#include "frangia/calibrate/check/internal/compare_views.h"
#include "frangia/calibrate/internal/artifact_model.h"
#include "frangia/core/error.h"
#include "frangia/core/linear_algebra.h"
#include "frangia/dataset/scan_folder.h"

namespace frangia {
namespace {

/// Mean and standard deviation of the mean.
struct MeanOf {
  double mean = 0.0;
  double sigma = 0.0;
};

MeanOf mean_of(const std::vector<double>& values) {
  MeanOf out;
  const auto count = static_cast<double>(values.size());
  for (const double value : values)
    out.mean += value / count;
  double square = 0.0;
  for (const double value : values)
    square += (value - out.mean) * (value - out.mean);
  if (values.size() > 1) out.sigma = std::sqrt(square / (count - 1.0) / count);
  return out;
}

/// std::vector<Eigen::Vector3d> of a view that lie on one surface of the artifact, in the rig
/// frame.
std::vector<Eigen::Vector3d> points_on(const ArtifactView& view, int surface, const Rig& rig) {
  const std::vector<Eigen::Vector3d> all = site_points(view.sites, rig);
  std::vector<Eigen::Vector3d> out;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (view.surface[i] == surface && all[i].allFinite()) out.push_back(all[i]);
  return out;
}

/// Center of a ball of known radius, which a cap determines far better than one whose radius is
/// free.
Eigen::Vector3d center_of(const std::vector<Eigen::Vector3d>& points,
                          Eigen::Vector3d center,
                          double radius_mm) {
  constexpr int kIterations = 10;
  for (int i = 0; i < kIterations; ++i) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& point : points) {
      const Eigen::Vector3d outwards = (point - center).normalized();
      normal += outwards * outwards.transpose();
      right += outwards * ((point - center).norm() - radius_mm);
    }
    center += solve_symmetric(normal, right);
  }
  return center;
}

}  // namespace

RigCheck check_balls_of(const Scan& scan,
                        const CheckRigOptions& options,
                        const CheckedCamera& camera,
                        const Run& run) {
  const Rig& rig = scan.rig;
  const auto& balls = std::get<Balls>(*scan.artifact);
  const ArtifactCapture capture = measure_balls(scan, rig, run);
  const std::size_t count = capture.surfaces.size();
  std::vector<double> spacings;
  std::vector<std::vector<double>> diameters(count);
  std::vector<std::vector<Eigen::Vector3d>> centers(count);
  std::vector<Eigen::Vector3d> all;
  for (const ArtifactView& view : capture.views) {
    const Eigen::Isometry3d to_zero =
        rig.turntable ? table_turn(rig, -view.angle_rad) : Eigen::Isometry3d::Identity();
    std::vector<Eigen::Vector3d> here;
    for (std::size_t b = 0; b < count; ++b) {
      const std::vector<Eigen::Vector3d> points = points_on(view, static_cast<int>(b), rig);
      const Sphere sphere = fit_sphere(points);
      diameters[b].push_back(2.0 * sphere.radius_mm);
      const Eigen::Vector3d center = center_of(points, sphere.center_mm, 0.5 * balls.diameter_mm);
      centers[b].push_back(to_zero * center);
      here.push_back(center);
      all.insert(all.end(), points.begin(), points.end());
    }
    if (count == 2) spacings.push_back((here[1] - here[0]).norm());
  }
  CheckLimits limits(
      camera, all, options, {.views = capture.views.size(), .left_out = capture.left_out});
  if (count == 2) {
    const MeanOf spacing = mean_of(spacings);
    limits.add("spacing",
               spacing.mean - *balls.spacing_mm,
               spacing.sigma,
               2.0,
               fmt::format("{:.4f} mm, {:g} mm are known", spacing.mean, *balls.spacing_mm));
  }
  for (std::size_t b = 0; b < count; ++b) {
    const MeanOf diameter = mean_of(diameters[b]);
    limits.add(count == 2 ? fmt::format("diameter {}", b + 1) : "diameter",
               diameter.mean - balls.diameter_mm,
               // A cap determines the diameter less well than a whole ball.
               diameter.sigma,
               4.0,
               fmt::format("{:.4f} mm, {:g} mm are known", diameter.mean, balls.diameter_mm));
  }
  if (!rig.turntable || capture.views.size() < 2) return limits.result();
  double square = 0.0;
  for (const std::vector<Eigen::Vector3d>& places : centers) {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& place : places)
      mean += place / static_cast<double>(places.size());
    for (const Eigen::Vector3d& place : places)
      square += (place - mean).squaredNorm() / static_cast<double>(places.size() * count);
  }
  limits.add("place of the balls",
             std::sqrt(square),
             0.0,
             1.0,
             fmt::format("differs by {:.4f} mm rms between the views", std::sqrt(square)));
  return limits.result();
}

namespace {

/// Views in which several cameras are compared with each other, spread over the scan.
constexpr std::size_t kComparedViews = 3;

/// Views of one camera, each compared with the same view of another.
std::vector<PartView> views_of(const Scan& scan,
                               std::size_t camera,
                               const CheckRigOptions& options,
                               const Run& run) {
  const Scan own = scan_of_camera(scan, camera);
  const std::size_t count = own.views.size();
  const std::size_t used = std::min(count, kComparedViews);
  std::vector<PartView> views;
  for (std::size_t i = 0; i < used; ++i) {
    run.check();
    views.push_back(measure_part_view(own, i * count / used, options.part_sites, run));
    views.back().camera_from_zero = scan.rig.cameras[camera].camera_from_rig();
  }
  return views;
}

}  // namespace

RigCheck check_cameras_of(const Scan& scan, const CheckRigOptions& options, const Run& run) {
  RigCheck all;
  const std::vector<PartView> reference = views_of(scan, 0, options, run);
  for (std::size_t camera = 1; camera < scan.rig.cameras.size(); ++camera) {
    const std::string& name = scan.rig.cameras[camera].camera.name;
    const std::vector<PartView> views = views_of(scan, camera, options, run);
    PatchDistances patches;
    std::vector<Eigen::Vector3d> points;  // in the frame of the camera
    for (std::size_t i = 0; i < views.size(); ++i) {
      compare_views(views[i], reference[i], options.match_share, patches);
      compare_views(reference[i], views[i], options.match_share, patches);
      for (const Eigen::Vector3d& point : views[i].points)
        if (point.allFinite()) points.push_back(point);
    }
    constexpr std::size_t kFewest = 5;
    if (points.empty() || patches.mean_mm.size() < kFewest) {
      throw Error(ErrorKind::Numeric,
                  fmt::format("camera \"{}\" and the reference camera share {} patches within "
                              "{:.2g} of their distance, too few to compare them: one of them is "
                              "far off, or they see different sides of the part",
                              name,
                              patches.mean_mm.size(),
                              options.match_share));
    }
    CheckLimits limits({scan.rig, camera}, points, options);
    limits.add_spread("against the reference", patches);
    all = joined(std::move(all), limits.result());
  }
  return all;
}

RigCheck check_part_of(const Scan& scan,
                       const CheckRigOptions& options,
                       const CheckedCamera& camera,
                       const Run& run) {
  const Rig& rig = scan.rig;
  if (scan.views.size() < 2) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: one view of a part has nothing to be compared with; scan it from "
                            "several angles, or state a plate or ball bar in [board]",
                            (scan.folder / "scan.toml").string()));
  }
  std::vector<PartView> views;
  std::vector<Eigen::Vector3d> all;
  for (std::size_t i = 0; i < scan.views.size(); ++i) {
    run.report(static_cast<double>(i) / static_cast<double>(scan.views.size()));
    run.check();
    // In another setup the part lies elsewhere on the table.
    if (scan.views[i].setup != scan.views.front().setup) continue;
    views.push_back(measure_part_view(scan, i, options.part_sites, run));
    views.back().camera_from_zero = table_turn(rig, scan.views[i].angle_rad);
    for (const Eigen::Vector3d& point : views.back().points)
      if (point.allFinite()) all.push_back(point);
  }
  if (all.empty()) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: no point of the part is measured; check that rig and scan belong "
                            "together",
                            (scan.folder / "scan.toml").string()));
  }
  PatchDistances patches;
  for (std::size_t a = 0; a < views.size(); ++a) {
    for (std::size_t b = 0; b < views.size(); ++b)
      if (a != b) compare_views(views[a], views[b], options.match_share, patches);
  }
  constexpr std::size_t kFewest = 20;
  if (patches.mean_mm.size() < kFewest) {
    throw Error(ErrorKind::Numeric,
                fmt::format("the views share {} patches within {:.3g} mm of each other, too few to "
                            "check the rig: it is far off, or the angles between the views are too "
                            "large",
                            patches.mean_mm.size(),
                            options.match_share * all.front().norm()));
  }
  CheckLimits limits(camera, all, options, {.views = views.size()});
  limits.add_spread("disagreement of the views", patches);
  return limits.result();
}

}  // namespace frangia
