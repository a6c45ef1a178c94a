#pragma once

#include <condition_variable>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "frangia/calibrate/board/board_view.h"
#include "frangia/calibrate/board/pose_coverage.h"
#include "frangia/calibrate/solve/calibrate_rig.h"
#include "frangia/core/run.h"
#include "frangia/rig/board.h"
#include "frangia/service/live_preview.h"
#include "frangia/service/project_scan.h"

namespace frangia {

/// Length of the ruler on a printed board, where the printer did not scale it.
inline constexpr double kPrintedRuler_mm = 100.0;

/// The board of a calibration: one that is described, or one of `kPrintedBoards`, which says by its
/// markers which it is.
struct WizardBoard {
  std::optional<Board> described;  ///< empty: it names itself
  double scale = 1.0;              ///< measured over true length of the print of the latter
};

/// A pose of the board that was captured.
struct WizardPose {
  std::size_t points = 0;    ///< of the board that were found
  std::size_t expected = 0;  ///< points of the whole board
};

/// What a calibration found, in the figures that matter to a user.
struct WizardVerdict {
  std::string grade;              ///< as calibration_grade; empty without a result
  double point_sigma_mm = 0.0;    ///< what the calibration adds to the uncertainty of a point
  double spread_mm = 0.0;         ///< how far points move when one pose is left out
  double distance_mm = 0.0;       ///< of the board from the camera, mean
  double baseline_mm = 0.0;       ///< camera to projector
  double camera_rms_px = 0.0;     ///< reprojection error of the camera
  double projector_rms_px = 0.0;  ///< reprojection error of the projector
  std::size_t poses = 0;          ///< that were used
};

/// How far a calibration has come.
struct WizardState {
  bool active = false;                ///< it captures, waits or computes
  bool waiting = false;               ///< for the board to stand in its next pose
  bool naming = false;                ///< waits for a printed board that says which it is
  std::size_t found = 0;              ///< points of the board in the live picture
  Board board;                        ///< that is captured
  std::size_t wanted = 0;             ///< poses
  std::vector<WizardPose> poses;      ///< that were captured
  PoseCoverage coverage;              ///< of all poses
  double field = 0.0;                 ///< share of the field that the poses cover
  bool sufficient = false;            ///< the poses determine a rig well
  std::vector<std::string> findings;  ///< of the checks before and after the adjustment
  std::string fault;                  ///< why there is no result; empty otherwise
  WizardVerdict verdict;              ///< of the last calibration
};

/// Captures poses of a board at a person's word and calibrates the rig of a project from them. One
/// thread calls `run`; the other functions may be called from any thread.
class CalibrationWizard {
 public:
  /// `on_change` is called after each change of the state or the picture.
  CalibrationWizard(ProjectFolder project, std::function<void()> on_change);

  [[nodiscard]] WizardState state() const {  ///< how far it has come
    const std::lock_guard lock(mutex_);
    return state_;
  }
  /// The newest picture of the camera with the points of the board; null before the first one.
  [[nodiscard]] std::shared_ptr<const LiveSnapshot> snapshot() const {
    const std::lock_guard lock(mutex_);
    return snapshot_;
  }
  /// The scan folder of the poses.
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  /// Captures the pose in which the board stands.
  ///
  /// @errors   Error(Input) when no pose is waited for
  void capture_pose();
  /// Ends the capture, so that the rig is calibrated from the poses so far. Errors as above.
  void end_poses();

  /// Captures until `poses` show the board or `end_poses` is called, calibrates, and replaces the
  /// project's rig.toml. The poses are kept in the project; a later run continues with them. The
  /// residuals are written to ProjectFolder::residuals, and the report of `frangia calibrate rig`
  /// to the project's exports.
  ///
  /// @errors   as open_devices, calibrate_capture and calibrate_rig
  void run(const WizardBoard& board,
           std::size_t poses,
           const CaptureSettings& settings,
           const CaptureSetup& setup,
           const Run& run);

 private:
  enum class Answer { None, Capture, End };
  void answer(Answer given);
  [[nodiscard]] bool wait_for_answer(RigDevices& devices,
                                     const Board& board,
                                     std::size_t number,
                                     const PoseCoverage& coverage,
                                     const Run& run);
  [[nodiscard]] Board wait_for_name(RigDevices& devices,
                                    const Scan& plan,
                                    const CameraSettings& camera,
                                    double scale,
                                    const Run& run);
  void show(Frame frame, int white_level, const std::vector<BoardPoint>& points);
  [[nodiscard]] Board capture(const WizardBoard& wanted,
                              std::size_t poses,
                              const CaptureSettings& settings,
                              const CaptureSetup& setup,
                              const Run& run);
  void solve(const Board& board, const Run& run);
  void keep(const RigCalibration& result, const Board& board);
  void change(const std::function<void(WizardState&)>& edit);

  ProjectFolder project_;
  std::filesystem::path folder_;
  std::function<void()> on_change_;
  mutable std::mutex mutex_;
  std::condition_variable answered_;
  Answer answer_ = Answer::None;
  WizardState state_;
  std::shared_ptr<const LiveSnapshot> snapshot_;
};

}  // namespace frangia
