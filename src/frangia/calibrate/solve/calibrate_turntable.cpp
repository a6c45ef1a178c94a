#include "frangia/calibrate/solve/calibrate_turntable.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/dataset/read_frames.h"

namespace frangia {

TurntableCalibration calibrate_turntable(const Scan& scan,
                                         const Rig& rig,
                                         const PoseOptions& options,
                                         double max_rms_px,
                                         const Run& run) {
  if (!scan.board) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: [board] is missing; add kind, corners and square_mm",
                            (scan.folder / "scan.toml").string()));
  }
  run.stage("board");
  TurntableCalibration result;
  std::vector<double> angles_rad;
  for (std::size_t i = 0; i < scan.views.size(); ++i) {
    run.report(static_cast<double>(i) / static_cast<double>(scan.views.size()));
    const std::string name = scan.views[i].folder.generic_string();
    PoseCapture pose =
        calibrate_measure_pose(read_frames(scan, i, run), *scan.board, rig, name, options, run);
    if (pose.view.points.empty()) {
      result.without_board.push_back(name);
      continue;
    }
    result.views.push_back(std::move(pose.view));
    angles_rad.push_back(scan.views[i].angle_rad);
  }
  run.stage("adjustment");
  result.solution = solve_turntable(*scan.board, result.views, angles_rad, rig);
  const double rms_px = result.solution.camera_residuals.rms_px;
  if (!(rms_px <= max_rms_px)) {
    throw Error(ErrorKind::Input,
                fmt::format("the board does not turn by the angles of scan.toml: the camera's "
                            "reprojection error is {:.1f} px; check angle_deg of each view, and "
                            "that the board stands still on the turntable",
                            rms_px));
  }
  if (!result.without_board.empty()) {
    run.warn(fmt::format("the board is not found in {}; the other {} views are used",
                         fmt::join(result.without_board, ", "),
                         result.views.size()));
  }
  // The y axis of the camera points down, and scanners stand upright.
  if (result.solution.turntable.axis.y() > 0.0) {
    run.warn(
        "the axis of the turntable points down in the image: the table turns against the sense of "
        "angle_deg, or the camera is upside down");
  }
  result.rig = rig;
  result.rig.turntable = result.solution.turntable;
  return result;
}

}  // namespace frangia
