#include "frangia/pipeline/calibrate_rig.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <ctime>
#include <variant>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/median.h"
#include "frangia/dataset/read_frames.h"

namespace frangia {
namespace {

[[noreturn]] void fail_calibration(const std::string& sentence) {
  throw Error(ErrorKind::Input, sentence);
}

/// Fails unless the fringes of a direction determine the absolute phase.
void require_direction(const Scan& scan, FringeDirection direction) {
  std::vector<Pattern> patterns;
  for (const Pattern& pattern : scan.patterns) {
    const bool coded = pattern.kind == PatternKind::Fringe || pattern.kind == PatternKind::Gray;
    if (coded && pattern.direction == direction) patterns.push_back(pattern);
  }
  const bool vertical = direction == FringeDirection::Vertical;
  const char* name = vertical ? "vertical" : "horizontal";
  const bool fringes = std::any_of(patterns.begin(), patterns.end(), [](const Pattern& pattern) {
    return pattern.kind == PatternKind::Fringe;
  });
  if (!fringes) {
    fail_calibration(
        fmt::format("{}: there are no {} fringes; a board needs both directions, so add patterns "
                    "with direction = \"{}\" and capture the poses again",
                    (scan.folder / "scan.toml").string(),
                    name,
                    name));
  }
  if (has_absolute_phase(patterns, scan.rig.projector)) return;
  fail_calibration(
      fmt::format("{}: the {} fringes have no absolute phase; add one with a period of the "
                  "projector's {}, and check the key direction of each pattern",
                  (scan.folder / "scan.toml").string(),
                  name,
                  vertical ? "width" : "height"));
}

void check_scan(const Scan& scan) {
  if (!scan.board) {
    fail_calibration(
        fmt::format("{}: [board] is missing; add kind = \"checkerboard\", corners and "
                    "square_mm",
                    (scan.folder / "scan.toml").string()));
  }
  if (scan.rig.projector.is_angular()) {
    fail_calibration(
        fmt::format("{}: projector.model is \"angular\", but a board calibrates a digital "
                    "projector, model = \"pinhole\"",
                    (scan.folder / "rig.toml").string()));
  }
  require_direction(scan, FringeDirection::Vertical);
  require_direction(scan, FringeDirection::Horizontal);
}

std::string today() {
  return fmt::format(
      "{:%Y-%m-%d}",
      fmt::gmtime(std::chrono::system_clock::to_time_t(std::chrono::system_clock::now())));
}

Rig calibrated(const Rig& known, const Board& board, const RigSolution& solution) {
  Rig rig = known;
  rig.camera.model = solution.camera;
  rig.projector.model = solution.projector;
  rig.projector.rotation = solution.projector_from_camera.linear();
  rig.projector.position_mm =
      -(rig.projector.rotation.transpose() * solution.projector_from_camera.translation());
  Calibration calibration;
  calibration.date = today();
  calibration.board = name_of(board.kind);
  calibration.poses = static_cast<int>(solution.camera_from_board.size());
  calibration.camera_rms_px = solution.camera_residuals.rms_px;
  calibration.projector_rms_px = solution.projector_residuals.rms_px;
  calibration.point_sigma_mm = solution.point_sigma_mm;
  calibration.distance_mm = solution.distance_mm;
  for (std::size_t i = 0; i < solution.parameters.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    calibration.sigma.emplace_back(solution.parameters[i],
                                   std::sqrt(solution.covariance(row, row)));
  }
  rig.calibration = calibration;
  return rig;
}

/// Names the poses whose reprojection error is far above that of the others.
void warn_of_outliers(const std::vector<BoardView>& views,
                      const std::vector<ResidualSummary>& by_view,
                      const char* device,
                      const CalibrateRigOptions& options,
                      const Run& run) {
  std::vector<double> errors;
  for (const ResidualSummary& summary : by_view)
    if (summary.points > 0) errors.push_back(summary.rms_px);
  if (errors.empty()) return;
  const double typical = median(errors);
  for (std::size_t i = 0; i < by_view.size(); ++i) {
    if (!(by_view[i].rms_px > std::max(options.outlier_rms * typical, options.outlier_floor_px)))
      continue;
    run.warn(fmt::format(
        "{}: the reprojection error of the {} is {:.2f} px, {:.1f} times the median of all poses; "
        "the board or the camera moved during its capture, or it is blurred",
        views[i].name,
        device,
        by_view[i].rms_px,
        by_view[i].rms_px / typical));
  }
}

/// Names a wrong square where rig.toml states the distance of camera and projector beforehand.
void warn_of_scale(const Scan& scan,
                   const RigSolution& solution,
                   double max_error,
                   const Run& run) {
  const Eigen::Vector3d& position_mm = scan.rig.projector.position_mm;
  if (!position_mm.allFinite() || position_mm.norm() == 0.0) return;
  const double found_mm = solution.projector_from_camera.translation().norm();
  const double ratio = position_mm.norm() / found_mm;
  if (std::abs(ratio - 1.0) < max_error) return;
  const bool circles = scan.board->kind == BoardKind::Circles;
  run.warn(
      fmt::format("the projector is {:.1f} mm from the camera, but projector.position_mm in "
                  "rig.toml states {:.1f} mm: if that is right, board.{} is {:.3g} mm, not {:g} mm",
                  found_mm,
                  position_mm.norm(),
                  circles ? "spacing_mm" : "square_mm",
                  ratio * scan.board->square_mm,
                  scan.board->square_mm));
}

std::string worst_view(const std::vector<BoardView>& views,
                       const std::vector<ResidualSummary>& by_view) {
  const auto worst =
      std::max_element(by_view.begin(), by_view.end(), [](const auto& a, const auto& b) {
        return a.rms_px < b.rms_px;
      });
  return views[static_cast<std::size_t>(worst - by_view.begin())].name;
}

void check_solution(const RigSolution& solution,
                    const std::vector<BoardView>& views,
                    double max_rms_px) {
  if (!solution.undetermined.empty()) {
    fail_calibration(
        fmt::format("the poses do not determine {}; capture more poses that fill the image and "
                    "are tilted by 20 to 40 degrees, each another way",
                    fmt::join(solution.undetermined, ", ")));
  }
  if (solution.camera_residuals.rms_px > max_rms_px) {
    fail_calibration(
        fmt::format("the poses contradict each other: the camera's reprojection error is {:.1f} "
                    "px, largest in {}; check board.corners and that the board is stiff",
                    solution.camera_residuals.rms_px,
                    worst_view(views, solution.camera_by_view)));
  }
  if (solution.projector_residuals.rms_px > max_rms_px) {
    fail_calibration(
        fmt::format("the fringes contradict the board: the projector's reprojection error is "
                    "{:.1f} px, largest in {}; check the order of the frames, shifts_deg and that "
                    "nothing moved during the capture",
                    solution.projector_residuals.rms_px,
                    worst_view(views, solution.projector_by_view)));
  }
}

}  // namespace

std::string calibration_grade(const RigSolution& solution) {
  struct Grade {
    double share;
    const char* name;
  };
  // 0.025, 0.1 and 0.5 mm at half a metre: inspection, good fringe projection, a maker's print.
  constexpr std::array<Grade, 3> kGrades{{{5e-5, "excellent"}, {2e-4, "good"}, {1e-3, "usable"}}};
  const double sigma_mm = std::max(solution.point_sigma_mm, solution.spread_mm);
  for (const Grade& grade : kGrades)
    if (sigma_mm <= grade.share * solution.distance_mm) return grade.name;
  return "poor";
}

RigCalibration calibrate_rig(const Scan& scan, const CalibrateRigOptions& options, const Run& run) {
  check_scan(scan);
  run.stage("board");
  std::vector<PoseCapture> poses;
  for (std::size_t i = 0; i < scan.views.size(); ++i) {
    run.report(static_cast<double>(i) / static_cast<double>(scan.views.size()));
    poses.push_back(calibrate_measure_pose(read_frames(scan, i, run),
                                           *scan.board,
                                           scan.rig,
                                           scan.views[i].folder.generic_string(),
                                           options.pose,
                                           run));
  }
  const PoseChecks checks = check_board_views(poses, *scan.board, scan.rig, options.check);
  for (const std::string& warning : checks.warnings)
    run.warn(warning);
  RigCalibration result;
  result.left_out = checks.left_out;
  for (PoseCapture& pose : poses) {
    const bool left_out =
        std::find(checks.left_out.begin(), checks.left_out.end(), pose.view.name) !=
        checks.left_out.end();
    if (left_out) continue;
    if (pose.view.points.empty()) {
      result.without_board.push_back(pose.view.name);
    } else {
      result.views.push_back(std::move(pose.view));
      result.pictures.push_back(std::move(pose.picture));
    }
  }
  if (!result.without_board.empty()) {
    run.warn(fmt::format("the board is not found in {}; the other {} poses are used",
                         fmt::join(result.without_board, ", "),
                         result.views.size()));
  }
  run.stage("adjustment");
  result.solution = solve_rig(*scan.board, result.views, scan.rig, options.solve, run);
  check_solution(result.solution, result.views, options.max_rms_px);
  warn_of_scale(scan, result.solution, options.max_scale_error, run);
  warn_of_outliers(result.views, result.solution.camera_by_view, "camera", options, run);
  warn_of_outliers(result.views, result.solution.projector_by_view, "projector", options, run);
  result.rig = calibrated(scan.rig, *scan.board, result.solution);
  return result;
}

}  // namespace frangia
