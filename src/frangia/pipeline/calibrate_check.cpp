// Over 250 lines: plate, balls and part share the limits and the uncertainty.
#include "frangia/pipeline/calibrate_check.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <span>
#include <utility>
#include <variant>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/median.h"
#include "frangia/core/symmetric_eigen.h"
#include "frangia/dataset/read_frames.h"
#include "frangia/pipeline/internal/calibrate_artifact_sites.h"
#include "frangia/pipeline/internal/calibrate_compare_views.h"
#include "frangia/range/calibration_uncertainty.h"

namespace frangia {
namespace {

using Points = std::vector<Eigen::Vector3d>;

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

/// Limits of the deviations of one check.
class CheckLimits {
 public:
  CheckLimits(const Rig& rig, const Points& points, const CheckRigOptions& options, RigCheck& check)
      : options_(options), check_(check) {
    for (const Eigen::Vector3d& point : points)
      check.distance_mm += point.norm() / static_cast<double>(points.size());
    if (!rig.calibration || rig.calibration->covariance.empty()) return;
    Pattern pattern;
    (rig.projector.is_angular() ? pattern.fringes_per_degree : pattern.period_px) = 1.0;
    Points some;
    constexpr std::size_t kMost = 500;
    for (std::size_t i = 0; i < points.size(); i += points.size() / kMost + 1)
      some.push_back(points[i]);
    const CalibrationUncertainty uncertainty(rig, pattern, some);
    double square = 0.0;
    for (const Eigen::Vector3d& point : some) {
      const Eigen::Vector2d pixel = rig.camera.model.project(point);
      square += std::pow(uncertainty.along_ray_mm(pixel.x(), pixel.y(), point.z()), 2);
    }
    check.calibration_sigma_mm = std::sqrt(square / static_cast<double>(some.size()));
  }

  /// Adds a figure. `points`: how many independent points of the calibration's uncertainty it has.
  void add(
      std::string name, double deviation_mm, double noise_mm, double points, std::string measured) {
    constexpr double kSigmas = 3.0;
    const double calibration_mm = std::sqrt(points) * check_.calibration_sigma_mm;
    const double sigma_mm = std::hypot(noise_mm, calibration_mm);
    const double floor_mm = options_.floor_share * check_.distance_mm;
    const double limit_mm = options_.tolerance_mm > 0.0 ? options_.tolerance_mm
                                                        : std::hypot(kSigmas * sigma_mm, floor_mm);
    check_.items.push_back(
        {std::move(name), deviation_mm, sigma_mm, limit_mm, std::move(measured)});
  }

 private:
  const CheckRigOptions& options_;
  RigCheck& check_;
};

void require_table(const Scan& scan, const Rig& rig) {
  if (rig.turntable || scan.views.size() < 2) return;
  throw Error(
      ErrorKind::Input,
      "the rig has no [turntable], so that its views cannot be compared; find the axis with "
      "`frangia calibrate turntable`, or check a scan of one view");
}

/// Points of a view that lie on one surface of the artifact, in the rig frame.
Points points_on(const ArtifactView& view, int surface, const Rig& rig) {
  const Points all = site_points(view.sites, rig);
  Points out;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (view.surface[i] == surface && all[i].allFinite()) out.push_back(all[i]);
  return out;
}

/// Center of a ball of known radius, which a cap determines far better than one whose radius is
/// free.
Eigen::Vector3d center_of(const Points& points, Eigen::Vector3d center, double radius_mm) {
  constexpr int kIterations = 10;
  for (int i = 0; i < kIterations; ++i) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& point : points) {
      const Eigen::Vector3d outwards = (point - center).normalized();
      normal += outwards * outwards.transpose();
      right += outwards * ((point - center).norm() - radius_mm);
    }
    center += normal.ldlt().solve(right);
  }
  return center;
}

void check_balls_of(const Scan& scan,
                    const Rig& rig,
                    const CheckRigOptions& options,
                    const Run& run,
                    RigCheck& check) {
  const auto& balls = std::get<Balls>(*scan.artifact);
  const ArtifactCapture capture = measure_balls(scan, rig, options.measure, run, check.left_out);
  check.views = capture.views.size();
  const std::size_t count = capture.surfaces.size();
  std::vector<double> spacings;
  std::vector<std::vector<double>> diameters(count);
  std::vector<Points> centers(count);
  Points all;
  for (const ArtifactView& view : capture.views) {
    const Eigen::Isometry3d to_zero =
        rig.turntable ? table_turn(rig, -view.angle_rad) : Eigen::Isometry3d::Identity();
    Points here;
    for (std::size_t b = 0; b < count; ++b) {
      const Points points = points_on(view, static_cast<int>(b), rig);
      const Sphere sphere = fit_sphere(points);
      diameters[b].push_back(2.0 * sphere.radius_mm);
      const Eigen::Vector3d center = center_of(points, sphere.center_mm, 0.5 * balls.diameter_mm);
      centers[b].push_back(to_zero * center);
      here.push_back(center);
      all.insert(all.end(), points.begin(), points.end());
    }
    if (count == 2) spacings.push_back((here[1] - here[0]).norm());
  }
  CheckLimits limits(rig, all, options, check);
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
  if (!rig.turntable || capture.views.size() < 2) return;
  double square = 0.0;
  for (const Points& places : centers) {
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
}

/// Signed distances of points from the plane that fits most of them best.
///
/// @shape    one for each point
std::vector<double> heights_of(const Points& points) {
  std::vector<double> heights(points.size(), 0.0);
  std::vector<bool> used(points.size(), true);
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    double count = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!used[i]) continue;
      center += points[i];
      count += 1.0;
    }
    center /= count;
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (std::size_t i = 0; i < points.size(); ++i)
      if (used[i]) spread += (points[i] - center) * (points[i] - center).transpose();
    const Eigen::Vector3d normal = symmetric_eigen(spread).vectors.col(0);
    std::vector<double> magnitudes;
    for (std::size_t i = 0; i < points.size(); ++i) {
      heights[i] = normal.dot(points[i] - center);
      magnitudes.push_back(std::abs(heights[i]));
    }
    constexpr double kGate = 5.0 * 1.4826;  // medians: edges of the plate
    const double gate = kGate * median(magnitudes);
    for (std::size_t i = 0; i < points.size(); ++i)
      used[i] = std::abs(heights[i]) <= gate;
  }
  return heights;
}

/// Standard deviation of heights by the median of their magnitudes, which the edges of a plate do
/// not change.
double spread_of(std::span<const double> heights) {
  std::vector<double> magnitudes;
  for (const double height : heights)
    magnitudes.push_back(std::abs(height));
  return 1.4826 * median(magnitudes);
}

/// Heights of a view averaged over patches, and the typical standard deviation of an average: the
/// noise of single sites is not a fault of the rig.
struct PatchHeights {
  std::vector<double> mean_mm;
  double sigma_mm = 0.0;
};

/// @shape    one pixel for each height
PatchHeights patch_heights(std::span<const double> heights,
                           std::span<const Eigen::Vector2d> pixels,
                           double patch_px) {
  constexpr double kFewest = 12.0;  // sites in a patch
  constexpr double kOverlap = 3.5;  // sites that share pixels
  struct Sums {
    double count = 0.0;
    double sum = 0.0;
    double squares = 0.0;
  };
  std::map<std::pair<long, long>, Sums> patches;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    Sums& patch =
        patches[{std::lround(pixels[i].x() / patch_px), std::lround(pixels[i].y() / patch_px)}];
    patch.count += 1.0;
    patch.sum += heights[i];
    patch.squares += heights[i] * heights[i];
  }
  PatchHeights out;
  std::vector<double> sigmas;
  for (const auto& [place, patch] : patches) {
    if (patch.count < kFewest) continue;
    const double mean = patch.sum / patch.count;
    const double variance = std::max(patch.squares / patch.count - mean * mean, 0.0);
    out.mean_mm.push_back(mean);
    sigmas.push_back(std::sqrt(variance * kOverlap / patch.count));
  }
  out.sigma_mm = median(sigmas);
  return out;
}

void check_plate_of(const Scan& scan,
                    const Rig& rig,
                    const CheckRigOptions& options,
                    const Run& run,
                    RigCheck& check) {
  const ArtifactCapture capture = measure_plate(scan, rig, options.measure, run, check.left_out);
  check.views = capture.views.size();
  const double patch_px = 8.0 * std::max(rig.camera.model.width_px, rig.camera.model.height_px) /
                          options.measure.plate_sites;
  Points all;
  Points turned;
  std::vector<Eigen::Vector2d> pixels;
  std::vector<std::size_t> ends;  // of each view's points among `turned`
  double worst = 0.0;
  double worst_sigma = 0.0;
  for (const ArtifactView& view : capture.views) {
    const Points points = site_points(view.sites, rig);
    const Eigen::Isometry3d to_zero =
        rig.turntable ? table_turn(rig, -view.angle_rad) : Eigen::Isometry3d::Identity();
    Points measured;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!points[i].allFinite()) continue;
      measured.push_back(points[i]);
      pixels.push_back(view.sites[i].camera_px);
      turned.push_back(to_zero * points[i]);
    }
    ends.push_back(turned.size());
    all.insert(all.end(), measured.begin(), measured.end());
    const PatchHeights patches =
        patch_heights(heights_of(measured), std::span(pixels).last(measured.size()), patch_px);
    const double flatness = spread_of(patches.mean_mm);
    if (patches.mean_mm.empty() || flatness < worst) continue;
    worst = flatness;
    worst_sigma = patches.sigma_mm;
  }
  if (worst == 0.0) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: the plate is too small in the image to be checked; let it fill a "
                            "third of it",
                            (scan.folder / "scan.toml").string()));
  }
  CheckLimits limits(rig, all, options, check);
  limits.add("flatness",
             worst,
             worst_sigma,
             1.0,
             fmt::format("{:.4f} mm from a plane in the worst view", worst));
  if (!rig.turntable || capture.views.size() < 2) return;
  const std::vector<double> heights = heights_of(turned);
  double together = 0.0;
  double together_sigma = 0.0;
  std::size_t begin = 0;
  for (const std::size_t end : ends) {
    const PatchHeights patches = patch_heights(std::span(heights).subspan(begin, end - begin),
                                               std::span(pixels).subspan(begin, end - begin),
                                               patch_px);
    begin = end;
    const double disagreement = spread_of(patches.mean_mm);
    if (patches.mean_mm.empty() || disagreement < together) continue;
    together = disagreement;
    together_sigma = patches.sigma_mm;
  }
  limits.add("disagreement of the views",
             together,
             together_sigma,
             1.0,
             fmt::format("{:.4f} mm from the plane of all views in the worst view", together));
}

void check_part(const Scan& scan,
                const Rig& rig,
                const CheckRigOptions& options,
                const Run& run,
                RigCheck& check) {
  if (scan.views.size() < 2) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: one view of a part has nothing to be compared with; scan it from "
                            "several angles, or state a plate or ball bar in [board]",
                            (scan.folder / "scan.toml").string()));
  }
  const CameraModel& model = rig.camera.model;
  SiteGrid grid;
  grid.step = std::max(1, std::max(model.width_px, model.height_px) / options.part_sites);
  grid.columns = (model.width_px - grid.step / 2 + grid.step - 1) / grid.step;
  grid.rows = (model.height_px - grid.step / 2 + grid.step - 1) / grid.step;
  MeasureLightOptions light;
  light.step_px = grid.step;
  light.use_laser_line = true;
  light.fit.radius_px = 2;
  light.fit.min_pixels = 15;
  std::vector<PartView> views;
  Points all;
  for (std::size_t i = 0; i < scan.views.size(); ++i) {
    run.report(static_cast<double>(i) / static_cast<double>(scan.views.size()));
    run.check();
    // A part that was set up anew is another part.
    if (scan.views[i].setup != scan.views.front().setup) continue;
    const std::vector<LightSite> sites = measure_light(read_frames(scan, i, run), rig, light, run);
    views.push_back({site_points(sites, rig), table_turn(rig, scan.views[i].angle_rad)});
    for (const Eigen::Vector3d& point : views.back().points)
      if (point.allFinite()) all.push_back(point);
  }
  check.views = views.size();
  if (all.empty()) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: no point of the part is measured; check that rig and scan belong "
                            "together",
                            (scan.folder / "scan.toml").string()));
  }
  PatchDistances patches;
  for (std::size_t a = 0; a < views.size(); ++a) {
    for (std::size_t b = 0; b < views.size(); ++b)
      if (a != b) compare_views(views[a], views[b], grid, rig, options.match_share, patches);
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
  CheckLimits limits(rig, all, options, check);
  const double typical = spread_of(patches.mean_mm);
  limits.add("disagreement of the views",
             typical,
             median(patches.sigma_mm),
             2.0,
             fmt::format("{:.4f} mm, robust, over {} patches", typical, patches.mean_mm.size()));
}

}  // namespace

bool RigCheckItem::passed() const {
  return std::abs(deviation_mm) <= limit_mm;
}

bool RigCheck::passed() const {
  return !items.empty() &&
         std::all_of(items.begin(), items.end(), std::mem_fn(&RigCheckItem::passed));
}

RigCheck calibrate_check(const Scan& scan,
                         const Rig& rig,
                         const CheckRigOptions& options,
                         const Run& run) {
  RigCheck check;
  check.kind = scan.artifact ? name_of(*scan.artifact) : "part";
  run.stage("views");
  require_table(scan, rig);
  if (scan.board || (scan.artifact && std::holds_alternative<Screen>(*scan.artifact))) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: a rig is checked by a plate, a ball, a ball-bar or a part on the "
                            "turntable; remove [board] or name another scan",
                            (scan.folder / "scan.toml").string()));
  }
  if (!scan.artifact) {
    check_part(scan, rig, options, run, check);
  } else if (std::holds_alternative<Plate>(*scan.artifact)) {
    check_plate_of(scan, rig, options, run, check);
  } else {
    check_balls_of(scan, rig, options, run, check);
  }
  return check;
}

}  // namespace frangia
