#include "calibrate_rig_verb.h"

#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "frangia/calibrate/write_covariance.h"
#include "frangia/core/angles.h"
#include "frangia/pipeline/calibrate_report.h"
#include "frangia/pipeline/calibrate_rig.h"
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

/// Length of the baseline and its standard deviation, mm.
std::pair<double, double> baseline_of(const RigSolution& solution) {
  const Eigen::Vector3d translation = solution.projector_from_camera.translation();
  const Eigen::Matrix3d covariance = solution.covariance.bottomRightCorner<3, 3>();
  const Eigen::Vector3d direction = translation.normalized();
  return {translation.norm(), std::sqrt(direction.dot(covariance * direction))};
}

void print_device(const char* name,
                  const char* prefix,
                  const CameraModel& model,
                  const ResidualSummary& residuals,
                  const RigSolution& solution) {
  const std::string parameter(prefix);
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
      sigma_of(solution, parameter + ".focal_px"),
      model.principal_point_px.x(),
      sigma_of(solution, parameter + ".principal_x_px"),
      model.principal_point_px.y(),
      sigma_of(solution, parameter + ".principal_y_px"));
}

void print_summary(const RigCalibration& result, const Board& board) {
  const RigSolution& solution = result.solution;
  print_text("calibrated by {} of a {} of {} x {} points\n",
             counted(result.views.size(), "pose"),
             name_of(board.kind),
             board.columns,
             board.rows);
  print_device("camera", "camera", solution.camera, solution.camera_residuals, solution);
  print_device(
      "projector", "projector", solution.projector, solution.projector_residuals, solution);
  const auto [baseline, baseline_sigma] = baseline_of(solution);
  const double angle =
      deg_from_rad(Eigen::AngleAxisd(solution.projector_from_camera.linear()).angle());
  print_text("  {:<10} {:.2f} ± {:.2f} mm, axes turned by {:.2f} degrees\n",
             "baseline",
             baseline,
             baseline_sigma,
             angle);
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
  const auto [baseline, baseline_sigma] = baseline_of(solution);
  nlohmann::ordered_json json{
      {"rig", arguments.output.string()},
      {"poses", result.views.size()},
      {"views_without_board", result.without_board},
      {"views_left_out", result.left_out},
      {"camera_rms_px", solution.camera_residuals.rms_px},
      {"projector_rms_px", solution.projector_residuals.rms_px},
      {"baseline_mm", baseline},
      {"baseline_sigma_mm", baseline_sigma},
      {"point_sigma_mm", solution.point_sigma_mm},
      {"distance_mm", solution.distance_mm},
      {"spread_mm", solution.spread_mm},
      {"grade", calibration_grade(solution)},
      {"estimated", solution.terms},
      {"held", solution.held},
  };
  for (const auto& [name, sigma] : result.rig.calibration->sigma)
    json["sigma"][name] = sigma;
  for (std::size_t i = 0; i < result.views.size(); ++i) {
    json["views"].push_back({{"folder", result.views[i].name},
                             {"camera_rms_px", solution.camera_by_view[i].rms_px},
                             {"projector_rms_px", solution.projector_by_view[i].rms_px},
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
  require(arguments.report.empty(), "`report` is for poses of one board only");
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
  ArtifactVerbOptions options{arguments.output, {}, arguments.flat_board};
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
