#include "calibrate_artifacts_verb.h"

#include <cmath>
#include <string>
#include <variant>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "frangia/calibrate/artifact/calibrate_artifacts.h"
#include "frangia/calibrate/report/artifact_report.h"
#include "frangia/calibrate/solve/calibrate_rig.h"
#include "frangia/core/angles.h"
#include "frangia/rig/write_rig.h"

#include "counted.h"
#include "print_text.h"

namespace frangia {
namespace {

/// Standard deviation of a parameter; 0 if it was held.
double sigma_in(const Rig& rig, const std::string& name) {
  for (const auto& [parameter, sigma] : rig.calibration->sigma)
    if (parameter == name) return sigma;
  return 0.0;
}

void print_camera(const CameraSolution& camera, const Rig& rig) {
  print_text("camera from {} of a screen\n", counted(camera.by_view.size(), "pose"));
  print_text("  {:<10} {:.3f} px rms, {:.2f} px at most, {} points\n",
             "camera",
             camera.residuals.rms_px,
             camera.residuals.max_px,
             camera.residuals.points);
  print_text(
      "  {:<10} focal length {:.3f} ± {:.3f} px, principal point ({:.3f} ± {:.3f}, {:.3f} ± "
      "{:.3f}) px\n",
      "",
      camera.camera.focal_px.x(),
      sigma_in(rig, "camera.focal_px"),
      camera.camera.principal_point_px.x(),
      sigma_in(rig, "camera.principal_x_px"),
      camera.camera.principal_point_px.y(),
      sigma_in(rig, "camera.principal_y_px"));
  const std::vector<std::string> none = {"nothing"};
  print_text("  {:<10} {}\n",
             "estimated",
             fmt::format("{}", fmt::join(camera.terms.empty() ? none : camera.terms, ", ")));
  print_text("  {:<10} {:.3f} mm at most\n", "screen", camera.bend_mm);
}

void print_table(const ArtifactCalibration& result) {
  const ArtifactSolution& table = *result.table;
  const Rig& rig = result.rig;
  std::size_t views = 0;
  std::vector<std::string> kinds;
  for (const ArtifactCapture& capture : result.captures) {
    views += capture.views.size();
    kinds.push_back(name_of(capture.artifact));
  }
  print_text("projector and turntable from {} of {}\n",
             counted(views, "view"),
             fmt::format("{}", fmt::join(kinds, " and ")));
  const Eigen::Vector3d& position = rig.projector.position_mm;
  print_text("  {:<10} at ({:.2f}, {:.2f}, {:.2f}) mm, residuals {:.4f} % of the field rms\n",
             "projector",
             position.x(),
             position.y(),
             position.z(),
             100.0 * table.light_rms / result.light_range);
  if (const auto* angular = std::get_if<AngularModel>(&rig.projector.model)) {
    const Eigen::Matrix3d& r = rig.projector.rotation;
    const double theta0 = std::atan2(r(0, 2), r(2, 2));
    print_text("  {:<10} theta0 {:.4f} ± {:.4f} degrees, pitch {:.6f} ± {:.6f} of that stated\n",
               "",
               deg_from_rad(theta0),
               deg_from_rad(sigma_in(rig, "projector.rotation_y_rad")),
               angular->pitch_scale,
               sigma_in(rig, "projector.pitch_scale"));
    if (!angular->wavefront.is_plane()) {
      std::vector<double> deviations;
      for (const double coefficient : angular->wavefront.coefficients_rad)
        deviations.push_back(deg_from_rad(coefficient));
      print_text("  {:<10} wavefront {} degrees (uu, vv, uuu, uuv, uvv, vvv)\n",
                 "",
                 fmt::format("{:.4f}", fmt::join(deviations, ", ")));
    }
  }
  print_text("  {:<10} direction ± {:.4f} degrees, place ± {:.4f} mm, angles ± {:.4f} degrees\n",
             "turntable",
             deg_from_rad(table.axis_sigma_rad),
             table.point_sigma_mm,
             deg_from_rad(table.angle_sigma_rad));
  if (table.line_rms_mm > 0.0) {
    print_text(
        "  {:<10} the laser line is {:.4f} mm rms off its sheet\n", "line", table.line_rms_mm);
  }
  for (std::size_t c = 0; c < result.captures.size(); ++c) {
    if (!std::holds_alternative<Balls>(result.captures[c].artifact)) continue;
    print_text("  {:<10} {} mm\n",
               "diameters",
               fmt::format("{:.4f}", fmt::join(table.diameters_mm[c], ", ")));
  }
  print_text("  {:<10} {}\n", "held", fmt::format("{}", fmt::join(table.held, ", ")));
  print_text(
      "  {:<10} {}: the calibration adds {:.3f} mm to the uncertainty of a point at {:.0f} mm\n",
      "grade",
      calibration_grade(rig.calibration->point_sigma_mm, rig.calibration->distance_mm),
      rig.calibration->point_sigma_mm,
      rig.calibration->distance_mm);
}

nlohmann::ordered_json json_of_artifacts(const ArtifactCalibration& result,
                                         const std::filesystem::path& output) {
  nlohmann::ordered_json json{{"rig", output.string()}, {"views_left_out", result.left_out}};
  for (const auto& [name, sigma] : result.rig.calibration->sigma)
    json["sigma"][name] = sigma;
  if (result.camera) {
    json["camera_rms_px"] = result.camera->residuals.rms_px;
    json["estimated"] = result.camera->terms;
    json["screen_bend_mm"] = result.camera->bend_mm;
  }
  if (!result.table) return json;
  const ArtifactSolution& table = *result.table;
  json["light_rms_share"] = table.light_rms / result.light_range;
  json["line_rms_mm"] = table.line_rms_mm;
  json["axis_sigma_deg"] = deg_from_rad(table.axis_sigma_rad);
  json["point_sigma_mm"] = table.point_sigma_mm;
  json["angle_sigma_deg"] = deg_from_rad(table.angle_sigma_rad);
  json["diameters_mm"] = table.diameters_mm;
  json["held"] = table.held;
  json["grade"] = calibration_grade(result.rig.calibration->point_sigma_mm,
                                    result.rig.calibration->distance_mm);
  json["calibration_sigma_mm"] = result.rig.calibration->point_sigma_mm;
  return json;
}

}  // namespace

void calibrate_by_artifacts(const std::vector<Scan>& scans,
                            const std::optional<Rig>& start,
                            const ArtifactVerbOptions& options,
                            Terminal& terminal) {
  CalibrateArtifactsOptions chosen;
  chosen.solve.baseline_mm = options.baseline_mm;
  chosen.camera.release_board = !options.flat_screen;
  ArtifactCalibration result = calibrate_artifacts(scans, start, chosen, terminal.run());
  std::filesystem::path covariance = options.output;
  covariance.replace_filename(options.output.stem().string() + "-covariance.csv");
  result.rig.calibration->covariance_file = covariance.filename().string();
  write_rig(options.output, result.rig, Durability::Buffered, scans.back().folder / "rig.toml");
  if (!options.report.empty()) write_artifact_report(options.report, result, terminal.warnings());
  terminal.finish();
  if (terminal.json) {
    nlohmann::ordered_json json = json_of_artifacts(result, options.output);
    json["warnings"] = terminal.warnings();
    print_json(json);
    return;
  }
  if (!terminal.quiet) {
    if (result.camera) print_camera(*result.camera, result.rig);
    if (result.table) print_table(result);
  }
  terminal.print_written(options.output.string());
  terminal.print_written(covariance.string());
  if (!options.report.empty()) terminal.print_written(options.report.string());
}

}  // namespace frangia
