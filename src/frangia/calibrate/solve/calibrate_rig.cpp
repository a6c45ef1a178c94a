#include "frangia/calibrate/solve/calibrate_rig.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <ctime>
#include <string>
#include <utility>
#include <vector>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/calibrate/board/calibrate_measure_pose.h"
#include "frangia/calibrate/board/check_board_views.h"
#include "frangia/calibrate/internal/assess_solution.h"
#include "frangia/core/error.h"
#include "frangia/core/run.h"
#include "frangia/dataset/read_frames.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/decode/plan_decoding.h"
#include "frangia/rig/rig.h"

namespace frangia {
namespace {

/// Reprojection error above which the poses contradict each other.
constexpr double kMaxRms_px = 5.0;

/// The poses as one camera sees them.
std::vector<PoseCapture> measure_poses(const Scan& scan,
                                       const PoseOptions& options,
                                       std::size_t camera,
                                       const Run& run) {
  const Scan own = scan_of_camera(scan, camera);
  const std::size_t all = scan.views.size() * scan.rig.cameras.size();
  std::vector<PoseCapture> poses;
  for (std::size_t i = 0; i < own.views.size(); ++i) {
    run.report(static_cast<double>(camera * own.views.size() + i) / static_cast<double>(all));
    poses.push_back(calibrate_measure_pose(read_frames(own, i, run),
                                           *own.board,
                                           own.rig,
                                           own.views[i].folder.generic_string(),
                                           options,
                                           run));
  }
  return poses;
}

/// The checks of the poses that one camera sees. Those of a further camera name it.
PoseChecks check_poses(const std::vector<PoseCapture>& poses,
                       const Scan& scan,
                       const PoseCheckOptions& options,
                       std::size_t camera,
                       const Run& run) {
  const Rig known = rig_of_camera(scan.rig, camera);
  const std::string prefix =
      camera > 0 ? fmt::format("camera \"{}\": ", known.reference().name) : std::string();
  try {
    PoseChecks checks = check_board_views(poses, *scan.board, known, options);
    for (const std::string& warning : checks.warnings)
      run.warn(prefix + warning);
    return checks;
  } catch (const Error& error) {
    throw Error(error.kind(), prefix + error.what());
  }
}

bool is_left_out(const PoseChecks& checks, const PoseCapture& pose) {
  return std::find(checks.left_out.begin(), checks.left_out.end(), pose.view.name) !=
         checks.left_out.end();
}

/// The calibration with the points of a further camera in its views.
RigCalibration with_camera(RigCalibration result,
                           const Scan& scan,
                           const CalibrateRigOptions& options,
                           std::size_t camera,
                           const std::vector<std::size_t>& used,
                           const Run& run) {
  std::vector<PoseCapture> poses = measure_poses(scan, options.pose, camera, run);
  const PoseChecks checks = check_poses(poses, scan, options.check, camera, run);
  result.left_out.insert(result.left_out.end(), checks.left_out.begin(), checks.left_out.end());
  std::vector<std::string> unseen;
  for (std::size_t i = 0; i < used.size(); ++i) {
    PoseCapture& pose = poses[used[i]];
    const bool left_out = is_left_out(checks, pose);
    if (!left_out && pose.view.points.empty()) unseen.push_back(pose.view.name);
    if (left_out) pose.view.points.clear();
    result.views[i].more.push_back(std::move(pose.view.points));
  }
  if (unseen.empty()) return result;
  run.warn(fmt::format("camera \"{}\": the board is not found in {}; the other {} poses are used",
                       scan.rig.cameras[camera].camera.name,
                       fmt::join(unseen, ", "),
                       used.size() - unseen.size()));
  result.without_board.insert(result.without_board.end(), unseen.begin(), unseen.end());
  return result;
}

/// Measures the board in all views by all cameras, checks the poses, and returns a calibration with
/// those that are usable, without its solution. A pose that the reference camera does not see is
/// not used; another camera may miss some.
///
/// @errors   as `check_board_views`; those of a further camera name it
RigCalibration collect_board_views(const Scan& scan,
                                   const CalibrateRigOptions& options,
                                   const Run& run) {
  RigCalibration result;
  std::vector<PoseCapture> poses = measure_poses(scan, options.pose, 0, run);
  const PoseChecks checks = check_poses(poses, scan, options.check, 0, run);
  result.left_out = checks.left_out;
  std::vector<std::size_t> used;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    PoseCapture& pose = poses[i];
    if (is_left_out(checks, pose)) continue;
    if (pose.view.points.empty()) {
      result.without_board.push_back(pose.view.name);
      continue;
    }
    used.push_back(i);
    result.views.push_back(std::move(pose.view));
    result.pictures.push_back(std::move(pose.picture));
  }
  if (!result.without_board.empty()) {
    run.warn(fmt::format("the board is not found in {}; the other {} poses are used",
                         fmt::join(result.without_board, ", "),
                         result.views.size()));
  }
  for (std::size_t camera = 1; camera < scan.rig.cameras.size(); ++camera)
    result = with_camera(std::move(result), scan, options, camera, used, run);
  return result;
}

[[noreturn]] void fail_calibration(const std::string& sentence) {
  throw Error(ErrorKind::Input, sentence);
}

FringeDirection other(FringeDirection direction) {
  return direction == FringeDirection::Vertical ? FringeDirection::Horizontal
                                                : FringeDirection::Vertical;
}

/// The fringes and codes of one direction.
std::vector<Pattern> patterns_of(const Scan& scan, FringeDirection direction) {
  std::vector<Pattern> patterns;
  for (const Pattern& pattern : scan.patterns) {
    const bool coded = pattern.kind == PatternKind::Fringe || pattern.kind == PatternKind::Gray;
    if (coded && pattern.direction == direction) patterns.push_back(pattern);
  }
  return patterns;
}

/// Whether both directions would determine the absolute phase if they were exchanged.
bool are_absolute_exchanged(const Scan& scan) {
  for (const FringeDirection direction : {FringeDirection::Vertical, FringeDirection::Horizontal}) {
    std::vector<Pattern> patterns = patterns_of(scan, other(direction));
    for (Pattern& pattern : patterns)
      pattern.direction = direction;
    if (patterns.empty() || !is_absolute(plan_decoding(patterns, scan.rig, {}))) return false;
  }
  return true;
}

/// Fails unless the fringes of a direction determine the absolute phase.
void require_direction(const Scan& scan, FringeDirection direction) {
  const std::vector<Pattern> patterns = patterns_of(scan, direction);
  const bool vertical = direction == FringeDirection::Vertical;
  const char* name = vertical ? "vertical" : "horizontal";
  if (patterns.empty()) {
    fail_calibration(
        fmt::format("{}: there are no {} fringes and no such Gray code; a board needs both "
                    "directions, so add patterns "
                    "with direction = \"{}\" and capture the poses again",
                    (scan.folder / "scan.toml").string(),
                    name,
                    name));
  }
  if (is_absolute(plan_decoding(patterns, scan.rig, {}))) return;
  if (are_absolute_exchanged(scan)) {
    fail_calibration(fmt::format(
        "{}: rows and columns of the projector are exchanged, the periods say: exchange "
        "the values \"vertical\" and \"horizontal\" of the key direction",
        (scan.folder / "scan.toml").string()));
  }
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
  if (scan.rig.projector.is_label && scan.rig.cameras.size() == 1) {
    fail_calibration(
        fmt::format("{}: projector.model is \"label\", which needs two cameras: add "
                    "[[more_cameras]], or set model = \"pinhole\" to calibrate the projector",
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
  if (solution.has_projector) {
    rig.projector.model = solution.projector;
    rig.projector.rotation = solution.projector_from_camera.linear();
    rig.projector.position_mm =
        -(rig.projector.rotation.transpose() * solution.projector_from_camera.translation());
  }
  for (std::size_t i = 0; i < solution.cameras.size(); ++i) {
    const SolvedCamera& found = solution.cameras[i];
    PosedCamera& posed = rig.cameras[i];
    posed.camera.model = found.model;
    if (i == 0) continue;
    posed.rotation = found.camera_from_rig.linear();
    posed.position_mm = -(posed.rotation.transpose() * found.camera_from_rig.translation());
  }
  Calibration calibration;
  calibration.date = today();
  calibration.board = name_of(board.kind);
  calibration.poses = static_cast<int>(solution.camera_from_board.size());
  calibration.camera_rms_px = solution.reference().residuals.rms_px;
  const SolvedCamera& reads = solution.cameras[solution.has_projector ? 0 : 1];
  calibration.projector_rms_px = reads.projector_residuals.rms_px;
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

}  // namespace

std::string calibration_grade(const RigSolution& solution) {
  return calibration_grade(std::max(solution.point_sigma_mm, solution.spread_mm),
                           solution.distance_mm);
}

std::string calibration_grade(double sigma_mm, double distance_mm) {
  struct Grade {
    double share;
    const char* name;
  };
  // 0.025, 0.1 and 0.5 mm at half a metre: inspection, good fringe projection, a maker's print.
  constexpr std::array<Grade, 3> kGrades{{{5e-5, "excellent"}, {2e-4, "good"}, {1e-3, "usable"}}};
  for (const Grade& grade : kGrades)
    if (sigma_mm <= grade.share * distance_mm) return grade.name;
  return "poor";
}

RigCalibration calibrate_rig(const Scan& scan, const CalibrateRigOptions& options, const Run& run) {
  check_scan(scan);
  run.stage("board");
  RigCalibration result = collect_board_views(scan, options, run);
  run.stage("adjustment");
  result.solution = solve_rig(*scan.board, result.views, scan.rig, options.solve, run);
  check_solution(result.solution, result.views, kMaxRms_px);
  warn_of_scale(scan, result.solution, options.max_scale_error, run);
  warn_of_outliers(result.views, result.solution, run);
  result.rig = calibrated(scan.rig, *scan.board, result.solution);
  return result;
}

}  // namespace frangia
