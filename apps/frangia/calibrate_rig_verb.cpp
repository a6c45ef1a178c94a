#include "calibrate_rig_verb.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "frangia/calibrate/report/calibration_report.h"
#include "frangia/calibrate/solve/calibrate_rig.h"
#include "frangia/calibrate/solve/write_covariance.h"
#include "frangia/core/angles.h"
#include "frangia/rig/read_rig.h"
#include "frangia/rig/write_rig.h"

#include "calibrate_artifacts_verb.h"
#include "check_can_write.h"
#include "counted.h"
#include "option_values.h"
#include "print_text.h"

namespace frangia {
namespace {

struct RigArguments {
  std::vector<std::filesystem::path> scans;
  std::filesystem::path output;
  std::filesystem::path report;
  bool flat_board = false;
  double length_mm = 0.0;  ///< 0: not known
};

/// Standard deviation of a parameter; 0 if it was held.
double sigma_of(const RigSolution& solution, const std::string& name) {
  for (std::size_t i = 0; i < solution.parameters.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    if (solution.parameters[i] == name) return std::sqrt(solution.covariance(row, row));
  }
  return 0.0;
}

/// Distance of a device from the reference camera and its standard deviation, mm. `prefix` begins
/// the names of its parameters.
std::pair<double, double> distance_of(const RigSolution& solution,
                                      const std::string& prefix,
                                      const Eigen::Vector3d& translation) {
  std::vector<Eigen::Index> rows;
  for (const char* axis : {"x_mm", "y_mm", "z_mm"}) {
    const auto found =
        std::find(solution.parameters.begin(), solution.parameters.end(), prefix + "." + axis);
    rows.push_back(found - solution.parameters.begin());
  }
  const Eigen::Matrix3d covariance = solution.covariance(rows, rows);
  const Eigen::Vector3d direction = translation.normalized();
  return {translation.norm(), std::sqrt(direction.dot(covariance * direction))};
}

void print_device(const std::string& name,
                  const std::string& prefix,
                  const CameraModel& model,
                  const ResidualSummary& residuals,
                  const RigSolution& solution) {
  print_text("  {:<10} {:.3f} px rms, {:.2f} px at most, {} points\n",
             name,
             residuals.rms_px,
             residuals.max_px,
             residuals.points);
  print_text(
      "  {:<10} focal length {:.2f} ± {:.2f} px, principal point ({:.2f} ± {:.2f}, {:.2f} ± "
      "{:.2f}) px\n",
      "",
      model.focal_px.x(),
      sigma_of(solution, prefix + ".focal_px"),
      model.principal_point_px.x(),
      sigma_of(solution, prefix + ".principal_x_px"),
      model.principal_point_px.y(),
      sigma_of(solution, prefix + ".principal_y_px"));
}

/// The distance of a device from the reference camera.
void print_distance(const char* label,
                    const std::string& prefix,
                    const Eigen::Isometry3d& from_camera,
                    const RigSolution& solution) {
  const auto [distance, sigma] = distance_of(solution, prefix, from_camera.translation());
  print_text("  {:<10} {:.2f} ± {:.2f} mm{}, axes turned by {:.2f} degrees\n",
             label,
             distance,
             sigma,
             std::string_view(label).empty() ? " from the camera" : "",
             deg_from_rad(Eigen::AngleAxisd(from_camera.linear()).angle()));
}

void print_summary(const RigCalibration& result, const Board& board) {
  const RigSolution& solution = result.solution;
  print_text("calibrated by {} of a {} of {} x {} points\n",
             counted(result.views.size(), "pose"),
             name_of(board.kind),
             board.columns,
             board.rows);
  const SolvedCamera& reference = solution.reference();
  print_device("camera", "camera", reference.model, reference.residuals, solution);
  if (solution.has_projector) {
    print_device(
        "projector", "projector", solution.projector, reference.projector_residuals, solution);
    print_distance("baseline", "projector", solution.projector_from_camera, solution);
  }
  for (const SolvedCamera& camera : std::span(solution.cameras).subspan(1)) {
    const std::string prefix = "camera-" + camera.name;
    print_device(camera.name, prefix, camera.model, camera.residuals, solution);
    print_distance("", prefix, camera.camera_from_rig, solution);
    print_text("  {:<10} {:.3f} px rms of the {}\n",
               "",
               camera.projector_residuals.rms_px,
               solution.has_projector
                   ? "projector, by the fringes that it sees"
                   : "projector pixels, against those that the reference camera reads");
  }
  const std::vector<std::string> none = {"nothing"};
  print_text("  {:<10} {}\n",
             "estimated",
             fmt::format("{}", fmt::join(solution.terms.empty() ? none : solution.terms, ", ")));
  print_text("  {:<10} {}\n",
             "held",
             fmt::format("{}", fmt::join(solution.held.empty() ? none : solution.held, ", ")));
  print_text(
      "  {:<10} {}: the calibration adds {:.3f} mm to the uncertainty of a point at {:.0f} mm; the "
      "poses differ by {:.3f} mm\n",
      "grade",
      calibration_grade(solution),
      solution.point_sigma_mm,
      solution.distance_mm,
      solution.spread_mm);
}

nlohmann::ordered_json json_of(const RigCalibration& result, const RigArguments& arguments) {
  const RigSolution& solution = result.solution;
  nlohmann::ordered_json json{
      {"rig", arguments.output.string()},
      {"poses", result.views.size()},
      {"views_without_board", result.without_board},
      {"views_left_out", result.left_out},
      {"camera_rms_px", solution.reference().residuals.rms_px},
      {"projector_rms_px", result.rig.calibration->projector_rms_px},
      {"point_sigma_mm", solution.point_sigma_mm},
      {"distance_mm", solution.distance_mm},
      {"spread_mm", solution.spread_mm},
      {"grade", calibration_grade(solution)},
      {"estimated", solution.terms},
      {"held", solution.held},
  };
  if (solution.has_projector) {
    const auto [baseline, sigma] =
        distance_of(solution, "projector", solution.projector_from_camera.translation());
    json["baseline_mm"] = baseline;
    json["baseline_sigma_mm"] = sigma;
  }
  for (const SolvedCamera& camera : std::span(solution.cameras).subspan(1)) {
    const auto [distance, sigma] =
        distance_of(solution, "camera-" + camera.name, camera.camera_from_rig.translation());
    json["more_cameras"].push_back({{"name", camera.name},
                                    {"rms_px", camera.residuals.rms_px},
                                    {"projector_rms_px", camera.projector_residuals.rms_px},
                                    {"distance_mm", distance},
                                    {"distance_sigma_mm", sigma}});
  }
  for (const auto& [name, sigma] : result.rig.calibration->sigma)
    json["sigma"][name] = sigma;
  for (std::size_t i = 0; i < result.views.size(); ++i) {
    json["views"].push_back({{"folder", result.views[i].name},
                             {"camera_rms_px", solution.reference().by_view[i].rms_px},
                             {"projector_rms_px", solution.reference().projector_by_view[i].rms_px},
                             {"leave_one_out_mm", solution.leave_one_out_mm[i]}});
    nlohmann::ordered_json points = nlohmann::ordered_json::array();
    for (const BoardPoint& point : result.views[i].points) {
      points.push_back({point.index,
                        point.camera_px.x(),
                        point.camera_px.y(),
                        point.projector_px.x(),
                        point.projector_px.y()});
    }
    json["views"].back()["points"] = std::move(points);
  }
  return json;
}

/// Calibrates by the board among the scans, if there is one, and then by the artifacts.
void calibrate_by_several(const std::vector<Scan>& scans,
                          const RigArguments& arguments,
                          Terminal& terminal) {
  std::optional<Rig> start;
  std::vector<Scan> artifacts;
  for (const Scan& scan : scans) {
    if (scan.artifact) {
      artifacts.push_back(scan);
      continue;
    }
    require(!start, "two scans hold poses of a board; put all poses into one scan");
    CalibrateRigOptions options;
    options.solve.release_board = !arguments.flat_board;
    const RigCalibration found = calibrate_rig(scan, options, terminal.run());
    start = found.rig;
    start->calibration->covariance = {found.solution.parameters, found.solution.covariance};
  }
  require(!artifacts.empty(), "two scans hold poses of a board; put all poses into one scan");
  for (const Scan& scan : artifacts)
    if (start && !start->turntable) start->turntable = scan.rig.turntable;
  ArtifactVerbOptions options{arguments.output, arguments.report, {}, arguments.flat_board};
  if (arguments.length_mm > 0.0) options.baseline_mm = arguments.length_mm;
  calibrate_by_artifacts(artifacts, start, options, terminal);
}

void calibrate_rig_verb(const RigArguments& arguments, Terminal& terminal) {
  check_can_write(arguments.output);
  if (!arguments.report.empty()) check_can_write(arguments.report);
  const Run run = terminal.run();
  std::vector<Scan> scans;
  for (const std::filesystem::path& folder : arguments.scans)
    scans.push_back(read_scan(folder, run, RigContent::StartValues));
  if (scans.size() > 1 || scans.front().artifact) {
    calibrate_by_several(scans, arguments, terminal);
    return;
  }
  const Scan& scan = scans.front();
  CalibrateRigOptions options;
  options.solve.release_board = !arguments.flat_board;
  options.pose.keep_picture = !arguments.report.empty();
  RigCalibration result = calibrate_rig(scan, options, run);
  std::filesystem::path covariance = arguments.output;
  covariance.replace_filename(arguments.output.stem().string() + "-covariance.csv");
  result.rig.calibration->covariance_file = covariance.filename().string();
  write_covariance(covariance, result.solution);
  write_rig(arguments.output, result.rig, Durability::Buffered, scan.folder / "rig.toml");
  if (!arguments.report.empty())
    write_calibration_report(arguments.report, result, *scan.board, terminal.warnings());
  terminal.finish();
  if (terminal.json) {
    nlohmann::ordered_json json = json_of(result, arguments);
    json["warnings"] = terminal.warnings();
    print_json(json);
    return;
  }
  if (!terminal.quiet) print_summary(result, *scan.board);
  terminal.print_written(arguments.output.string());
  terminal.print_written(covariance.string());
  if (!arguments.report.empty()) terminal.print_written(arguments.report.string());
}

}  // namespace

void add_calibrate_rig_verb(CLI::App& calibrate, Terminal& terminal) {
  auto arguments = std::make_shared<RigArguments>();
  CLI::App* verb = calibrate.add_subcommand(
      "rig", "find camera, projector and turntable from a board, screen, plate or ball bar");
  verb->footer(
      "Example:\n  frangia calibrate rig poses -o rig.toml\n"
      "poses is a scan folder: its views are poses of a board with fringes in both directions, "
      "its\n"
      "scan.toml describes the [board], and its rig.toml holds at least the sizes of camera and\n"
      "projector. See docs/calibration.md.\n"
      "  frangia calibrate rig screen plate ball-bar -o rig.toml\n"
      "calibrates a rig with an interferometer: the camera by a [board] of kind \"screen\", the "
      "rest "
      "by\n"
      "a plate and a ball bar on the turntable.");
  verb->add_option("SCAN",
                   arguments->scans,
                   "the scan folder with the poses; several, each with another kind of board")
      ->required();
  verb->add_option("--length",
                   arguments->length_mm,
                   "distance of camera and projector, which gives the scale where no ball does")
      ->transform(length_above_zero());
  verb->add_option("-o,--output", arguments->output, "rig.toml to write")->required();
  verb->add_flag("--flat-board",
                 arguments->flat_board,
                 "take the board as exactly flat and square, such as a glass board, and do not "
                 "estimate its shape");
  verb->add_option("--report",
                   arguments->report,
                   "write a page with pictures of residuals, coverage and boards, as HTML");
  verb->callback([arguments, &terminal] { calibrate_rig_verb(*arguments, terminal); });
}

}  // namespace frangia
