#include "frangia/calibrate/artifact/calibrate_artifacts.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>
#include <variant>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/calibrate/internal/artifact_model.h"
#include "frangia/core/error.h"
#include "frangia/range/calibration_uncertainty.h"

namespace frangia {
namespace {

/// Above it the poses of a screen contradict each other.
constexpr double kMaxCameraRms_px = 2.0;

/// Root mean square of the residuals, as a share of the range of the light, above which the views
/// contradict each other.
constexpr double kMaxLightShare = 0.004;

template <typename Kind>
bool is_kind(const Scan& scan) {
  return scan.artifact && std::holds_alternative<Kind>(*scan.artifact);
}

/// The camera from all poses of a screen.
CameraSolution camera_from_screens(std::span<const Scan> scans,
                                   const CalibrateArtifactsOptions& options,
                                   const Run& run,
                                   std::vector<ScreenView>& views) {
  const Scan* first = nullptr;
  for (const Scan& scan : scans) {
    if (!is_kind<Screen>(scan)) continue;
    if (first == nullptr) first = &scan;
    const auto& a = std::get<Screen>(*first->artifact);
    const auto& b = std::get<Screen>(*scan.artifact);
    require(a.pixel_mm == b.pixel_mm && a.width_px == b.width_px && a.height_px == b.height_px,
            "the scans of a screen state two sizes; calibrate with one screen");
    std::vector<ScreenView> more = measure_screen(scan, run);
    std::move(more.begin(), more.end(), std::back_inserter(views));
  }
  const CameraModel& model = first->rig.reference().model;
  CameraSolution solution = solve_camera(std::get<Screen>(*first->artifact),
                                         views,
                                         model.width_px,
                                         model.height_px,
                                         options.camera,
                                         run);
  if (!(solution.residuals.rms_px <= kMaxCameraRms_px)) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: the poses of the screen contradict each other: the camera's "
                            "reprojection error is {:.1f} px; check board.size_px, period_px and "
                            "that nothing moved during a pose",
                            (first->folder / "scan.toml").string(),
                            solution.residuals.rms_px));
  }
  return solution;
}

void take_camera(const CameraSolution& solution, Rig& rig) {
  rig.reference().model = solution.camera;
  Calibration calibration;
  calibration.covariance = {solution.parameters, solution.covariance};
  rig.calibration = calibration;
}

void check_start(const Rig& rig) {
  const bool complete = rig.projector.position_mm.allFinite() &&
                        rig.projector.rotation.allFinite() &&
                        rig.reference().model.focal_px.allFinite();
  if (complete) return;
  throw Error(ErrorKind::Input,
              rig.reference().model.focal_px.allFinite()
                  ? "rig.toml does not state where the projector is; add projector.position_mm and "
                    "projector.rotation, within a few degrees and 10 %"
                  : "rig.toml does not state the intrinsics of the camera; add them, or calibrate "
                    "with a screen or board as well");
}

/// Scales all lengths of a rig but those of the camera.
Rig scaled(Rig rig, double scale) {
  rig.projector.position_mm *= scale;
  if (rig.turntable) {
    rig.turntable->point_mm *= scale;
    rig.turntable->point_sigma_mm *= scale;
  }
  if (rig.laser_sheet) rig.laser_sheet->offset_mm *= scale;
  return rig;
}

/// Ratio of the stated to the measured size of balls.
double scale_of(const ArtifactCapture& capture, double measured_radius_mm) {
  const auto& balls = std::get<Balls>(capture.artifact);
  if (!balls.spacing_mm) return 0.5 * balls.diameter_mm / measured_radius_mm;
  return *balls.spacing_mm / (capture.surfaces[1].head<3>() - capture.surfaces[0].head<3>()).norm();
}

double mean_radius(const ArtifactCapture& capture, const Rig& rig) {
  double sum = 0.0;
  double count = 0.0;
  for (const ArtifactView& view : capture.views) {
    std::vector<Eigen::Vector3d> first;
    const std::vector<Eigen::Vector3d> points = site_points(view.sites, rig);
    for (std::size_t i = 0; i < points.size(); ++i)
      if (view.surface[i] == 0 && points[i].allFinite()) first.push_back(points[i]);
    if (first.size() < 10) continue;
    sum += fit_sphere(first).radius_mm;
    count += 1.0;
  }
  return sum / count;
}

/// Uncertainty of the points on the artifacts, and their mean distance.
void set_point_sigma(const std::vector<ArtifactCapture>& captures, Rig& rig) {
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector2d> pixels;
  constexpr std::size_t kEvery = 23;
  for (const ArtifactCapture& capture : captures) {
    for (const ArtifactView& view : capture.views) {
      const std::vector<Eigen::Vector3d> all = site_points(view.sites, rig);
      for (std::size_t i = 0; i < all.size(); i += kEvery) {
        if (!all[i].allFinite()) continue;
        points.push_back(all[i]);
        pixels.push_back(view.sites[i].camera_px);
      }
    }
  }
  if (points.empty()) return;
  Pattern pattern;
  (rig.projector.is_angular() ? pattern.fringes_per_degree : pattern.period_px) = 1.0;
  const CalibrationUncertainty uncertainty(rig, pattern, {.points_mm = points, .shared = {}});
  double square = 0.0;
  double distance = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    square += std::pow(uncertainty.along_ray_mm(points[i], pixels[i]), 2);
    distance += points[i].norm();
  }
  const auto count = static_cast<double>(points.size());
  rig.calibration->point_sigma_mm = std::sqrt(square / count);
  rig.calibration->distance_mm = distance / count;
}

double light_range_of(const std::vector<ArtifactCapture>& captures) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const ArtifactCapture& capture : captures) {
    for (const ArtifactView& view : capture.views) {
      for (const LightSite& site : view.sites) {
        low = std::min(low, site.light.x());
        high = std::max(high, site.light.x());
      }
    }
  }
  return high - low;
}

/// Adds `[calibration]` to the result.
void describe(std::span<const Scan> scans, ArtifactCalibration& result) {
  Calibration calibration = result.rig.calibration.value_or(Calibration{});
  calibration.date = fmt::format(
      "{:%Y-%m-%d}",
      fmt::gmtime(std::chrono::system_clock::to_time_t(std::chrono::system_clock::now())));
  std::vector<std::string> kinds;
  calibration.poses = 0;
  for (const Scan& scan : scans) {
    kinds.push_back(name_of(*scan.artifact));
    calibration.poses += static_cast<int>(scan.views.size());
  }
  calibration.poses -= static_cast<int>(result.left_out.size());
  if (!calibration.board.empty()) kinds.insert(kinds.begin(), calibration.board);
  calibration.board = fmt::format("{}", fmt::join(kinds, ", "));
  if (result.camera) calibration.camera_rms_px = result.camera->residuals.rms_px;
  if (result.table && !result.rig.projector.is_angular())
    calibration.projector_rms_px = result.table->light_rms;
  calibration.sigma.clear();
  const RigCovariance& covariance = calibration.covariance;
  for (std::size_t i = 0; i < covariance.parameters.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    calibration.sigma.emplace_back(covariance.parameters[i],
                                   std::sqrt(std::max(covariance.covariance(row, row), 0.0)));
  }
  result.rig.calibration = calibration;
}

/// Scales a rig whose plates left its scale open, and the surfaces found with it.
Rig rescaled(const Rig& rig, double scale, std::span<ArtifactCapture> captures) {
  for (ArtifactCapture& capture : captures) {
    const bool plate = std::holds_alternative<Plate>(capture.artifact);
    for (Eigen::Vector4d& surface : capture.surfaces) {
      surface.tail<1>() *= scale;
      if (!plate) surface.head<3>() *= scale;
    }
  }
  return scaled(rig, scale);
}

/// Measures all plates and adjusts projector and table to them.
void calibrate_by_plates(std::span<const Scan> scans,
                         const CalibrateArtifactsOptions& options,
                         const Run& run,
                         ArtifactCalibration& result) {
  run.stage("plate");
  for (const Scan& scan : scans) {
    if (is_kind<Plate>(scan))
      result.captures.push_back(measure_plate(scan, result.rig, options, run));
  }
  if (result.captures.empty()) return;
  run.stage("adjustment");
  result.table = solve_artifacts(result.captures, result.rig, options.solve, run);
  for (std::size_t c = 0; c < result.captures.size(); ++c)
    result.captures[c].surfaces = result.table->surfaces[c];
}

/// Measures all balls and adjusts projector and table to plates and balls together.
void calibrate_by_balls(std::span<const Scan> scans,
                        const CalibrateArtifactsOptions& options,
                        const Run& run,
                        ArtifactCalibration& result) {
  run.stage("balls");
  // The start of this adjustment is the result of the plates', but its prior is that of the start:
  // the same data must not count twice.
  const Rig& start = result.rig;
  Rig rig = result.table ? result.table->rig : start;
  rig.calibration = start.calibration;
  rig.reference() = start.reference();
  if (!start.projector.is_angular()) rig.projector = start.projector;
  const std::size_t plates = result.captures.size();
  for (const Scan& scan : scans) {
    if (is_kind<Balls>(scan)) result.captures.push_back(measure_balls(scan, rig, run));
  }
  if (plates > 0 && !options.solve.baseline_mm && start.projector.is_angular()) {
    const ArtifactCapture& balls = result.captures[plates];
    rig = rescaled(rig, scale_of(balls, mean_radius(balls, rig)), result.captures);
  }
  run.stage("adjustment");
  result.table = solve_artifacts(result.captures, rig, options.solve, run);
}

/// Projector and table from plates, then from plates and balls together.
void calibrate_table(std::span<const Scan> scans,
                     const CalibrateArtifactsOptions& options,
                     const Run& run,
                     ArtifactCalibration& result) {
  check_start(result.rig);
  require(result.rig.turntable.has_value(),
          "rig.toml has no [turntable], on which plates and balls turn; add point_mm and axis, "
          "within a few degrees");
  calibrate_by_plates(scans, options, run, result);
  if (std::any_of(scans.begin(), scans.end(), is_kind<Balls>))
    calibrate_by_balls(scans, options, run, result);
  result.rig = result.table->rig;
  result.light_range = light_range_of(result.captures);
  if (result.table->light_rms > kMaxLightShare * result.light_range) {
    throw Error(ErrorKind::Input,
                fmt::format("the views contradict each other: the phases deviate by {:.2g} % of "
                            "their range from plates and balls that turn with the table; check "
                            "angle_deg and the sense in which it counts, the sizes in [board], and "
                            "that the artifact stands still on the table",
                            100.0 * result.table->light_rms / result.light_range));
  }
  Calibration calibration = result.rig.calibration.value_or(Calibration{});
  calibration.covariance = {result.table->parameters, result.table->covariance};
  result.rig.calibration = calibration;
}

}  // namespace

ArtifactCalibration calibrate_artifacts(std::span<const Scan> scans,
                                        const std::optional<Rig>& start,
                                        const CalibrateArtifactsOptions& options,
                                        const Run& run) {
  require(!scans.empty(), "there is no scan to calibrate by");
  const Scan* table = nullptr;
  for (const Scan& scan : scans) {
    if (!scan.artifact) {
      throw Error(ErrorKind::Input,
                  fmt::format("{}: [board] is missing, or is not a screen, plate, ball or ball-bar",
                              (scan.folder / "scan.toml").string()));
    }
    if (table == nullptr && !is_kind<Screen>(scan)) table = &scan;
  }
  ArtifactCalibration result;
  result.rig = start ? *start : table != nullptr ? table->rig : scans.front().rig;
  if (std::any_of(scans.begin(), scans.end(), is_kind<Screen>)) {
    run.stage("screen");
    result.camera = camera_from_screens(scans, options, run, result.screens);
    take_camera(*result.camera, result.rig);
  }
  if (table != nullptr) calibrate_table(scans, options, run, result);
  for (const ArtifactCapture& capture : result.captures) {
    result.left_out.insert(result.left_out.end(), capture.left_out.begin(), capture.left_out.end());
  }
  describe(scans, result);
  if (table != nullptr) set_point_sigma(result.captures, result.rig);
  if (!result.left_out.empty()) {
    run.warn(fmt::format("the artifact is not found in {}; the other views are used",
                         fmt::join(result.left_out, ", ")));
  }
  return result;
}

}  // namespace frangia
