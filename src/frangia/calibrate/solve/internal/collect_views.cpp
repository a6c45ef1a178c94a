#include "frangia/calibrate/solve/internal/collect_views.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/calibrate/board/calibrate_measure_pose.h"
#include "frangia/calibrate/board/check_board_views.h"
#include "frangia/core/error.h"
#include "frangia/dataset/read_frames.h"
#include "frangia/dataset/scan_of_camera.h"
#include "frangia/rig/rig_of_camera.h"

namespace frangia {
namespace {

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

}  // namespace

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

}  // namespace frangia
