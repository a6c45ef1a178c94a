#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "frangia/acquisition/capture_options.h"
#include "frangia/calibrate/board/board_view.h"
#include "frangia/calibrate/board/pose_coverage.h"
#include "frangia/core/folder_lock.h"
#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/devices/rig_devices.h"

namespace frangia {

/// One captured pose of a board, and what all poses so far cover.
struct CapturedPose {
  std::size_t number = 0;    ///< from 1, poses of earlier sessions included
  std::string folder;        ///< of the view
  std::size_t points = 0;    ///< of the board that were found
  std::size_t expected = 0;  ///< points of the whole board
  PoseCoverage coverage;     ///< of all poses so far
};

/// How poses of a board are captured.
struct CalibrateCaptureOptions {
  CaptureOptions capture;  ///< exposure, repeated attempts and time limits
  std::size_t poses = 12;  ///< by hand: the capture ends with this number of poses with the board
  /// By hand: waits until the board stands in its next pose; false ends the capture with the poses
  /// so far. Empty: the turntable moves the board.
  std::function<bool(std::size_t number, const PoseCoverage& so_far)> wait_for_pose;
  std::function<void(const CapturedPose&)> on_pose;  ///< called after each pose
};

/// Poses that were captured.
struct CalibrateCaptureReport {
  CaptureReport capture;                   ///< frames, retries and times
  PoseCoverage coverage;                   ///< of all poses
  std::vector<std::string> without_board;  ///< folders of the views without the board
};

/// Largest number of poses by hand in one folder.
inline constexpr std::size_t kMaxPosesByHand = 100;

/// Captures poses of the board of `plan` into `plan.folder`, for `calibrate_rig`; on the turntable,
/// at the angles of its views, also for `calibrate_turntable`.
///
/// It is durable and continues as `capture_scan` does; a pose by hand that was interrupted is left
/// out. After each pose the board is looked for, and the coverage so far decides which pose is
/// wanted next. By hand the views of `plan` are replaced.
///
/// @errors   Error(Input) when the plan has no board, or no pose was captured; those of
///           `capture_scan`
[[nodiscard]] CalibrateCaptureReport calibrate_capture(const Scan& plan,
                                                       RigDevices& devices,
                                                       const FolderLock& lock,
                                                       const CalibrateCaptureOptions& options,
                                                       const Run& run = {});

}  // namespace frangia
